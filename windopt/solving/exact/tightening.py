"""Tightening: subset rows of full memory over a pool, and the pool that they leave.

With every flight of interest in hand pricing is a look at each, so rows may be added by the
hundred; each round raises the bound and drops the flights beyond the gap that is left.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, hstack, vstack

from formulations.set_partitioning import set_partitioning
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.relaxation import MARGIN
from windopt.solving.exact.search import Search
from windopt.solving.exact.subset_row_cuts import MOST_VIOLATED, Triples, spread, violations

FIRST, BATCH = 4000, 1000
"""Flights in the first linear program, and to add at once."""
ROUNDS, ROWS, EACH = 60, 100, 6
"""Rounds of rows; rows in a round, and how many of them may share a turbine."""
LEAST_VIOLATION = 0.02
"""Violation from which a row is added."""
SMALL = 1500
"""Flights few enough to leave the rest to branch and bound."""
SATISFIED = 15_000
"""Flights few enough to stop when rows no longer help much."""
HELPFUL = 0.02
"""Part of the gap that a round of rows must close."""


@dataclass(frozen=True)
class Tightened:
    """The flights left, their reduced costs, and the bound they are measured from.

    Parameters
    ----------
    triples
        The subset rows that matter.
    value
        The bound.
    together
        How much of the flights that visit both turbines is flown, shape ``(n, n)``.
    sent
        How many flights each station and all send, shape ``(k + 1,)``.
    """

    pool: Pool
    reduced: Floats
    triples: Triples
    value: float
    together: Floats
    sent: Floats


class Selection:
    """A linear program over the flights of a pool that seem to matter.

    Parameters
    ----------
    triples
        Subset rows to begin with.
    price
        Of leaving each turbine out, shape ``(n,)``.
    """

    def __init__(self, n: int, counts: Floats, triples: Triples, price: Floats) -> None:
        self.n, self.counts, self.triples, self.price = n, counts, triples, price
        self.members: Bools = np.zeros((0, n), bool)
        self.station: Ints = np.zeros(0, np.int32)
        self._program = set_partitioning(n, counts, integer=False, cover=True, price=price)
        self._program.add_subset_rows(csr_array((len(triples), n)))

    def add(self, pool: Pool) -> None:
        """Add the flights of ``pool``."""
        members = pool.members(self.n)
        coefficients = flight_rows(members, pool.station, len(self.counts), self.triples)
        self._program.add_flights(pool.cost, coefficients)
        self.members = np.vstack([self.members, members])
        self.station = np.concatenate([self.station, pool.station])

    def cut(self, triples: Triples) -> None:
        """Add rows."""
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
        pi = np.clip(dual[: self.n], 0.0, self.price)
        duals = Duals(pi, dual[self.n : rows], np.maximum(-dual[rows:], 0.0))
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
    cut = pairs(members, triples).T.astype(float)
    blocks = [csc_array(members.T.astype(float)), csc_array(sent), csc_array(cut)]
    return csc_array(vstack(blocks))


def tighten(
    pool: Pool,
    reduced: Floats,
    triples: Triples,
    counts: Floats,
    target: float,
    search: Search,
    prove: Callable[[float], None],
) -> Tightened | None:
    """Raise the bound over ``pool`` towards ``target``.

    Parameters
    ----------
    reduced
        A guess at the reduced costs, to begin with the flights that matter.
    triples
        Subset rows to begin with.
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    target
        Only plans cheaper than this are looked for.
    prove
        Told of each bound on the plans over ``pool`` that are cheaper than ``target``.

    Returns
    -------
    What is left; None where no flight is, so that ``target`` is a bound.
    """
    inside = np.zeros(len(pool), bool)
    inside[np.argsort(reduced, kind="stable")[:FIRST]] = True
    selection = Selection(search.n, counts, triples, search.forfeit)
    selection.add(pool.kept(inside))
    before = -np.inf
    for _ in range(ROUNDS):
        duals, x, reduced = price_out(selection, pool, inside, search.clock)
        value = duals.value(counts) + search.most_flights * min(0.0, reduced.min(initial=0.0))
        gap = target - value + MARGIN
        keep = reduced <= gap
        pool, reduced, inside = pool.kept(keep), reduced[keep], inside[keep]
        if gap <= MARGIN or not len(pool):
            prove(target)
            return None
        prove(value)
        flown = x > 1e-6
        if len(pool) <= SMALL or (x[flown] > 1 - 1e-6).all():
            break
        if len(pool) <= SATISFIED and value - before < HELPFUL * gap:
            break
        visits = np.ascontiguousarray(selection.members[flown].T.astype(np.int64))
        found, violation = violations(visits, x[flown], LEAST_VIOLATION, MOST_VIOLATED)
        best = spread(found, violation, search.n, ROWS, EACH)
        if not len(best):
            break
        selection.cut(found[best])
        before = value
    members = selection.members.astype(float)
    together = members.T @ (x[:, None] * members)
    sent = np.bincount(selection.station, x, minlength=len(counts) - 1)
    triples = selection.triples[duals.penalty > 1e-7]
    return Tightened(pool, reduced, triples, value, together, np.append(sent, sent.sum()))


def price_out(
    selection: Selection, pool: Pool, inside: Bools, clock: Clock
) -> tuple[Duals, Floats, Floats]:
    """Solve the linear program over the whole pool.

    Parameters
    ----------
    inside
        Which flights are in the program; kept up to date.

    Returns
    -------
    Duals, flights flown, and the reduced cost of each flight of the pool.
    """
    slices = pool.slices(selection.n, clock)
    while True:
        duals, x = selection.solve(clock)
        reduced = reduced_costs(pool, slices, duals, selection.triples, clock)
        lacking = np.flatnonzero((reduced < -1e-6) & ~inside)
        if not len(lacking):
            return duals, x, reduced
        lacking = lacking[np.argsort(reduced[lacking], kind="stable")[:BATCH]]
        selection.add(pool.kept(lacking))
        inside[lacking] = True
