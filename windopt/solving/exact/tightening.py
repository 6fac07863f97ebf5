"""Tightening: rank-one rows over a pool, and the pool that they leave.

With every flight of interest in hand pricing is a look at each, so rows may be added by the
hundred; each round raises the bound and drops the flights beyond the gap that is left.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.fixing import MARGIN
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.rank_one_rows import Rows, violated_rows
from windopt.solving.exact.row_duals import RowDuals
from windopt.solving.exact.search import Search
from windopt.solving.exact.selection import Selection
from windopt.solving.exact.subset_row_cuts import MOST_VIOLATED, spread, violations

FIRST, BATCH = 4000, 1000
"""Flights in the first linear program, and to add at once."""
ROUNDS, ROWS, EACH = 60, 100, 6
"""Rounds of rows; rows in a round, and how many of them may share a turbine."""
CANDIDATES = 3000
"""Most violated subset rows to choose them from."""
SAMPLED = 4
"""One in so many flights is looked at to tell how long a row is."""
FEW = 50
"""Violated subset rows so few that rows of four and five turbines are looked for as well."""
LEAST_VIOLATION = 0.02
"""Violation from which a row is added."""
SATISFIED = 60_000
"""Flights few enough to stop when rows no longer help much."""
HELPFUL, BARELY = 0.2, 0.003
"""Part of the gap that a round of rows must close, with few flights left and with many."""
SLOW = 0.2
"""Part of the gap below which a round of rows of three turbines is followed by larger ones."""
PRICE = 1e-7
"""Penalty up to which a row does not matter."""


@dataclass(frozen=True)
class Tightened:
    """The flights left, their reduced costs, and the bound they are measured from.

    Parameters
    ----------
    pool
        Empty where the bound has reached its target.
    duals, rows
        The last prices that did not exceed the target, and the rank-one rows that matter, one to a
        penalty. They prove the bound where flights are left.
    value
        The bound.
    selection, x
        The linear program that proves it, and how much of each of its flights is flown.
    """

    pool: Pool
    reduced: Floats
    duals: Duals
    rows: Rows
    value: float
    selection: Selection
    x: Floats

    @property
    def together(self) -> Floats:
        """How much of the flights that visit both turbines is flown, shape ``(n, n)``."""
        members = self.selection.members.astype(float)
        together: Floats = members.T @ (self.x[:, None] * members)
        return together

    @property
    def sent(self) -> Floats:
        """How many flights each station and all send, shape ``(k + 1,)``."""
        stations = len(self.selection.counts) - 1
        sent = np.bincount(self.selection.station, self.x, minlength=stations)
        return np.append(sent, sent.sum())


def tighten(
    pool: Pool,
    reduced: Floats,
    rows: Rows,
    counts: Floats,
    target: float,
    search: Search,
    prove: Callable[[float], None],
    few: int,
) -> Tightened:
    """Raise the bound over ``pool`` towards ``target``.

    Parameters
    ----------
    reduced, rows
        A guess at the reduced costs, and rank-one rows to begin with.
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    target, prove
        Only plans cheaper than ``target`` are looked for; ``prove`` is told of bounds on them.
    few
        Flights few enough to leave the rest to branch and bound.

    Returns
    -------
    What is left; where no flight is, ``target`` is a bound.
    """
    selection, inside = _selected(pool, reduced, rows, counts, search)
    before, larger = -np.inf, False
    for _ in range(ROUNDS):
        duals, x, reduced = price_out(selection, pool, inside, search.clock)
        value = duals.value(counts) + search.most_flights * min(0.0, reduced.min(initial=0.0))
        gap = target - value + MARGIN
        if value <= target or before == -np.inf:  # beyond, the program has too few flights
            prices = RowDuals(duals, selection.rows).without_small(PRICE)
        keep = (reduced <= gap) & (gap > MARGIN)
        pool, reduced, inside = pool.kept(keep), reduced[keep], inside[keep]
        value = value if len(pool) else target
        prove(value)
        gain = value - before
        stalls = gain < (HELPFUL if len(pool) <= SATISFIED else BARELY) * gap
        if len(pool) <= few or _whole(x) or (stalls and larger):
            break
        larger, before = larger or gain < SLOW * gap, value
        x = _leave_out(selection, x, gap + MARGIN)
        selection.keep_rows(duals.penalty > PRICE)
        if not _add_violated(selection, x, larger, search.clock):
            break
    return Tightened(pool, reduced, *prices, value, selection, x)


def _selected(
    pool: Pool, reduced: Floats, rows: Rows, counts: Floats, search: Search
) -> tuple[Selection, Bools]:
    """Return a program over the flights that seem to matter, and which they are."""
    inside = np.zeros(len(pool), bool)
    inside[np.argsort(reduced, kind="stable")[:FIRST]] = True
    selection = Selection(search.n, counts, rows, search.forfeit, search.ceiling, search.crowded)
    selection.add(pool.kept(inside))
    return selection, inside


def _leave_out(selection: Selection, x: Floats, beyond: float) -> Floats:
    """Leave flights of a larger reduced cost out of a program; return what it flies of the others.

    Rows make a program dense, so that one of few flights is solved much sooner.
    """
    keep = selection.reduced_costs() <= beyond
    keep[: len(selection.counts) - 1] = True  # idle flights
    selection.keep_flights(keep)
    return x[keep]


def _whole(x: Floats) -> bool:
    """Tell whether each flight is flown or not, none in part."""
    return bool((x[x > 1e-6] > 1 - 1e-6).all())


def _add_violated(selection: Selection, x: Floats, larger: bool, clock: Clock) -> bool:
    """Add rows that the plan ``x`` violates, and tell whether there are any."""
    flown = x > 1e-6
    found = _violated(selection.members, flown, x[flown], larger, clock)
    if found.m:
        selection.cut(found)
    return bool(found.m)


def _violated(members: Bools, flown: Bools, x: Floats, larger: bool, clock: Clock) -> Rows:
    """Return rows that a fractional plan violates.

    Parameters
    ----------
    members
        Whether each flight of the program visits each turbine, shape ``(flights, n)``.
    flown, x
        Which flights the plan flies, and how much of each of these.
    larger
        Whether to look for rows of four and five turbines even if there are enough of three.
    """
    visits = np.ascontiguousarray(members[flown].T.astype(np.int64))
    triples, violation = violations(visits, x, LEAST_VIOLATION, MOST_VIOLATED)
    most = np.argsort(-violation, kind="stable")[:CANDIDATES]
    found = _deepest(Rows.subsets(triples[most]), violation[most], members)
    if larger or found.m < FEW:
        others = violated_rows(members[flown], x, LEAST_VIOLATION, clock)
        found = found.joined(_deepest(*others, members))
    return found


def _deepest(rows: Rows, violation: Floats, members: Bools) -> Rows:
    """Return the rows that a plan is farthest from, spread over the farm.

    That is violation over length; how long a row is as a vector is told from a sample of the
    program's flights, and one of coefficient 1, which all rows have somewhere.

    Parameters
    ----------
    violation
        Of each row, shape ``(m,)``.
    members
        Whether each flight of the program visits each turbine, shape ``(flights, n)``.
    """
    sample = rows.coefficients(members[::SAMPLED])
    length = np.sqrt(((sample**2).sum(axis=0) + 1.0) / (len(sample) + 1))
    places = np.where(rows.weight > 0, rows.turbines, rows.turbines[:, :1])
    return rows.kept(spread(places, violation / length, members.shape[1], ROWS, EACH))


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
        reduced = reduced_costs(pool, slices, duals, selection.rows, clock)
        lacking = np.flatnonzero((reduced < -1e-6) & ~inside)
        if not len(lacking):
            return duals, x, reduced
        lacking = lacking[np.argsort(reduced[lacking], kind="stable")[:BATCH]]
        selection.add(pool.kept(lacking))
        inside[lacking] = True
