"""Cases: a proof over a list of flights, as rounds of prices and questions with two answers.

What the search may leave to HiGHS is done here in the open: a linear program over the list, subset
rows as long as they help, and where they no longer do a question that parts the plans in two. A
round is recorded when flights are dropped by it, so that whoever verifies the record needs no
other.

* [1] Ryan & Foster (1981), in *Computer Scheduling of Public Transport*, 269-280.
"""

from dataclasses import dataclass, replace

import numpy as np

from windopt.domain.certificate import Case, Question, Round, Sent, Together
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.selection import Selection
from windopt.solving.exact.subset_row_cuts import MOST_VIOLATED, Triples, spread, violations
from windopt.solving.exact.tightening import (
    EACH,
    FIRST,
    HELPFUL,
    LEAST_VIOLATION,
    ROWS,
    price_out,
)

SHRUNK = 0.6
"""What is left of the gap when a round is worth a record."""
MARGIN, CLOSED = 3e-8, 5e-8
"""Parts of the target: what the gap is widened by before flights are dropped, and gaps that are
none. Whoever verifies keeps fewer flights and asks for less."""
DECIMALS = 9
"""Of what is recorded, in seconds; what rounding does to a bound is allowed for."""
FRACTIONAL = 0.05
"""Distance from a whole number from which a number of flights is asked about."""
NEGLIGIBLE = 1e-6
"""A share of a flight, or a price, that is none."""


@dataclass(frozen=True)
class Left:
    """The flights left in a case.

    Parameters
    ----------
    reduced
        A guess at their reduced costs.
    triples
        Subset rows to begin with.
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    """

    pool: Pool
    reduced: Floats
    triples: Triples
    counts: Floats

    def kept(self, keep: Bools) -> "Left":
        """Return the case with the flights ``keep`` alone."""
        return replace(self, pool=self.pool.kept(keep), reduced=self.reduced[keep])

    def impossible(self, search: Search) -> bool:
        """Tell whether a turbine that needs one, or a station that must send one, has no flight."""
        sent = np.bincount(self.pool.station, minlength=len(self.counts) - 1)
        lacking = (self.counts[:-1, 0] > 0) & (sent == 0)
        visited = self.pool.members(search.n).any(axis=0)
        return bool(lacking.any() or (np.isinf(search.prize) & ~visited).any())


def prove(left: Left, target: float, search: Search) -> Case:
    """Prove that no plan over the flights ``left`` takes less than ``target``."""
    if left.impossible(search):
        return Case()
    rounds, left, flown = _rounds(left, target, search)
    if flown is None or left.impossible(search):
        return Case(rounds)
    question, yes, no = _ask(left, flown)
    return Case(rounds, question, prove(yes, target, search), prove(no, target, search))


@dataclass(frozen=True)
class Flown:
    """The plan of a linear program.

    Parameters
    ----------
    members
        Whether each flight visits each turbine, shape ``(m, n)``.
    station
        Of each flight.
    x
        How much of each flight is flown.
    """

    members: Bools
    station: Ints
    x: Floats

    def together(self) -> Floats:
        """Return how much of the flights that visit both turbines is flown, shape ``(n, n)``."""
        members = self.members.astype(float)
        together: Floats = members.T @ (self.x[:, None] * members)
        return together

    def sent(self, stations: int) -> Floats:
        """Return how many flights each station and all send."""
        each = np.bincount(self.station, self.x, minlength=stations)
        sent: Floats = np.append(each, each.sum())
        return sent


def _rounds(
    left: Left, target: float, search: Search
) -> tuple[tuple[Round, ...], Left, Flown | None]:
    """Add subset rows as long as they help.

    Returns
    -------
    The rounds worth a record, the flights that they leave, and the plan of the last linear
    program; None where it takes ``target`` or longer.
    """
    inside = np.zeros(len(left.pool), bool)
    inside[np.argsort(left.reduced, kind="stable")[:FIRST]] = True
    pool, counts = left.pool, left.counts
    price, none = np.minimum(search.prize, target), CrowdedSets.none(search.n)
    selection = Selection(search.n, counts, Rows.subsets(left.triples), price, target, none)
    selection.add(pool.kept(inside))
    rounds: list[Round] = []
    recorded, before = np.inf, -np.inf
    while True:
        duals, x, reduced = price_out(selection, pool, inside, search.clock)
        value = duals.value(counts) + search.n * min(0.0, reduced.min(initial=0.0))
        gap = target - value
        closed = gap <= CLOSED * target
        flown = _flown(selection, x)
        helps = not closed and value - before >= HELPFUL * gap
        rows = _violated(flown) if helps else left.triples[:0]
        if closed or not len(rows) or gap < SHRUNK * recorded:
            rounds.append(as_round(duals, selection.rows.turbines[:, :3], counts, search.unit))
            recorded = gap
            keep = reduced <= gap + MARGIN * target
            pool, reduced, inside = pool.kept(keep), reduced[keep], inside[keep]
        if closed or not len(rows):
            triples = selection.rows.turbines[:, :3][duals.penalty > NEGLIGIBLE]
            return tuple(rounds), Left(pool, reduced, triples, counts), None if closed else flown
        selection.cut(Rows.subsets(rows))
        before = value


def _flown(selection: Selection, x: Floats) -> Flown:
    used = x > NEGLIGIBLE
    return Flown(selection.members[used], selection.station[used], x[used])


def _violated(flown: Flown) -> Triples:
    """Return subset rows that a plan violates, spread over the farm."""
    visits = np.ascontiguousarray(flown.members.T.astype(np.int64))
    triples, violation = violations(visits, flown.x, LEAST_VIOLATION, MOST_VIOLATED)
    return triples[spread(triples, violation, len(visits), ROWS, EACH)]


def as_round(duals: Duals, triples: Triples, counts: Floats, unit: float) -> Round:
    """Return duals, which must not be of crowded sets, as a round, in seconds.

    Parameters
    ----------
    triples
        The subset row of each of ``duals.penalty``.
    unit
        Seconds in which the duals are counted.
    """
    penalties = np.round(duals.penalty * unit, DECIMALS)
    paid = penalties > 0
    prices, tolls = np.round(duals.pi * unit, DECIMALS), np.round(duals.sigma * unit, DECIMALS)
    tolls[(tolls < 0) & np.isinf(counts[:, 1])] = 0.0
    return Round(prices, tolls, triples[paid], penalties[paid])


def _ask(left: Left, flown: Flown) -> tuple[Question, Left, Left]:
    """Return a question that the plan ``flown`` answers with neither yes nor no.

    Raises
    ------
    ProofError
        If it answers all questions: then it is better than what is to be proved.
    """
    sent = flown.sent(len(left.counts) - 1)
    fraction = np.abs(sent - np.round(sent))
    if fraction.max() > FRACTIONAL:
        return _ask_how_many(left, int(fraction.argmax()), sent)
    return _ask_who_with_whom(left, flown.together())


def _ask_how_many(left: Left, station: int, sent: Floats) -> tuple[Question, Left, Left]:
    most = int(np.floor(sent[station]))
    fewer, more = left.counts.copy(), left.counts.copy()
    fewer[station, 1], more[station, 0] = most, most + 1
    return Sent(station, most), replace(left, counts=fewer), replace(left, counts=more)


def _ask_who_with_whom(left: Left, together: Floats) -> tuple[Question, Left, Left]:
    upper = np.triu(np.ones_like(together, dtype=bool), 1)
    undecided = np.where(upper, np.abs(together - 0.5), np.inf)
    first, second = (int(i) for i in np.unravel_index(undecided.argmin(), undecided.shape))
    if undecided[first, second] > 0.5 - NEGLIGIBLE:
        raise ProofError("A plan over the list lies below the bound.")
    members = left.pool.members(len(together))
    one, other = members[:, first], members[:, second]
    return Together(first, second), left.kept(one == other), left.kept(~(one & other))
