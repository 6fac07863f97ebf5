"""Tightening: subset rows of full memory over a pool, and the pool that they leave.

With every flight of interest in hand pricing is a look at each, so rows may be added by the
hundred; each round raises the bound and drops the flights beyond the gap that is left.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, hstack, vstack

from formulations.set_partitioning import set_partitioning
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Inspection, Pool
from windopt.solving.exact.relaxation import MARGIN, Relaxation
from windopt.solving.exact.search import Search
from windopt.solving.exact.subset_row_cuts import Triples, spread, violations

FIRST, BATCH = 4000, 1000
"""Flights in the first linear program, and to add at once."""
ROUNDS, ROWS, EACH = 40, 100, 6
"""Rounds of rows; rows in a round, and how many of them may share a turbine."""
SMALL = 1500
"""Flights few enough to leave the rest to branch and bound."""
SATISFIED = 15_000
"""Flights few enough to stop when rows no longer help much."""


@dataclass(frozen=True)
class Tightened:
    """The flights left, their reduced costs, and the bound they are measured from.

    Parameters
    ----------
    triples
        The subset rows that matter.
    value
        The bound.
    """

    pool: Pool
    reduced: Floats
    triples: Triples
    value: float


class Selection:
    """A linear program over the flights of a pool that seem to matter.

    Parameters
    ----------
    triples
        The subset rows to begin with.
    price
        Of leaving a turbine out, so dear that a plan of interest leaves out none.
    """

    def __init__(self, n: int, counts: Floats, triples: Triples, price: float) -> None:
        self.n, self.counts, self.triples = n, counts, triples
        self.members: Bools = np.zeros((0, n), bool)
        self._program = set_partitioning(n, counts, integer=False, cover=True, price=price)
        self._program.add_subset_rows(csr_array((len(triples), n)))

    def add(self, pool: Pool) -> None:
        """Add the flights of ``pool``."""
        members = pool.members(self.n)
        coefficients = flight_rows(members, pool.station, len(self.counts), self.triples)
        self._program.add_flights(pool.cost, coefficients)
        self.members = np.vstack([self.members, members])

    def cut(self, triples: Triples) -> None:
        """Add subset rows."""
        flights = csr_array(pairs(self.members, triples).T.astype(float))
        left_out = csr_array((len(triples), self.n))
        self._program.add_subset_rows(csr_array(hstack([left_out, flights])))
        self.triples = np.vstack([self.triples, triples])

    def solve(self, clock: Clock) -> tuple[Duals, Floats]:
        """Return duals and flights flown."""
        model = self._program.model
        clock.run(model)
        solution = model.getSolution()
        dual = np.array(solution.row_dual)
        rows = self.n + len(self.counts)
        duals = Duals(
            np.maximum(dual[: self.n], 0.0), dual[self.n : rows], np.maximum(-dual[rows:], 0.0)
        )
        return duals, np.array(solution.col_value)[self.n :]


def pairs(members: Bools, triples: Triples) -> Bools:
    """Return whether each flight visits two or more of each triple, shape ``(m, triples)``."""
    a, b, c = (members[:, triples[:, q]] for q in range(3))
    return (a & b) | (a & c) | (b & c)


def flight_rows(members: Bools, station: Ints, counts: int, triples: Triples) -> csc_array:
    """Return the coefficients of flights in all rows of the set-partitioning program."""
    sent = np.zeros((counts, len(members)))
    sent[station, np.arange(len(members))] = 1.0
    sent[-1] = 1.0
    cut = pairs(members, triples).T
    blocks = [csc_array(members.T.astype(float)), csc_array(sent), csc_array(cut.astype(float))]
    return csc_array(vstack(blocks))


def tighten(pool: Pool, relaxation: Relaxation, target: float, search: Search) -> Tightened | None:
    """Raise the bound over ``pool`` towards ``target``.

    Parameters
    ----------
    relaxation
        Whose duals and cuts to begin with.
    target
        Only plans cheaper than this are looked for.

    Returns
    -------
    What is left; None where no flight is, so that ``target`` is a bound.
    """
    duals, triples, counts = relaxation.duals, relaxation.master.cuts.triples, relaxation.counts
    inspection = Inspection(pool, pool.slices(search.n, search.clock))
    reduced = inspection.reduced_costs(duals, triples, search.clock)
    gap = target - duals.value(counts) + MARGIN
    pool, reduced = pool.kept(reduced <= gap), reduced[reduced <= gap]
    selection = Selection(search.n, counts, triples, search.ceiling)
    chosen = np.argsort(reduced, kind="stable")[:FIRST]
    selection.add(pool.kept(chosen))
    inside = np.zeros(len(pool), bool)
    inside[chosen] = True
    before = -np.inf
    for _ in range(ROUNDS):
        inspection = Inspection(pool, pool.slices(search.n, search.clock))
        while True:
            duals, x = selection.solve(search.clock)
            reduced = inspection.reduced_costs(duals, selection.triples, search.clock)
            lacking = np.flatnonzero((reduced < -1e-6) & ~inside)
            if not len(lacking):
                break
            lacking = lacking[np.argsort(reduced[lacking], kind="stable")[:BATCH]]
            selection.add(pool.kept(lacking))
            inside[lacking] = True
        value = duals.value(counts) + search.most_flights * min(0.0, reduced.min(initial=0.0))
        search.prove(min(value, target))
        gap = target - value + MARGIN
        keep = reduced <= gap
        pool, reduced, inside = pool.kept(keep), reduced[keep], inside[keep]
        if gap <= MARGIN or not len(pool):
            search.prove(target)
            return None
        flown = x > 1e-6
        done = len(pool) <= SMALL or (x[flown] > 1 - 1e-6).all()
        stuck = len(pool) <= SATISFIED and value - before < 0.02 * gap
        if done or stuck:
            break
        visits = np.ascontiguousarray(selection.members[flown].T.astype(np.int64))
        found, violation = violations(visits, x[flown], 0.02, 200_000)
        best = spread(found, violation, search.n, ROWS, EACH)
        if not len(best):
            break
        selection.cut(found[best])
        before = value
    active = duals.penalty > 1e-7
    return Tightened(pool, reduced, selection.triples[active], value)
