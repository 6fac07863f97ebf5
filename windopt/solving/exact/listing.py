"""Listing: all flights of a plan cheaper than a target, as few others as prices can tell apart.

Flights are screened by the prices of the last list. Beforehand nobody knows whether the screen lets
enough pass; afterwards that is seen, and if it does not the list is made again.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf, log
from typing import NamedTuple

from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.fixing import MARGIN, Fixing
from windopt.solving.exact.network import Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.row_duals import RowDuals, mixed
from windopt.solving.exact.screening import Screen, together_below
from windopt.solving.exact.search import TOLERATED, ProofError, Search

MIX, SPARE = 0.5, 1.5
"""Share of the last list's prices in the mix that screens the next; and the first limit, in
multiples of what the mix leaves up to the target. Of eight lists of Nysted six needed no more, and
with larger shares most lists grew longer, since more flights fell below zero."""


class Size(NamedTuple):
    """How large a list was: up to which reduced cost, of how many pairs of halves, and flights."""

    delta: float
    pairs: int
    flights: int


class Listing(NamedTuple):
    """A list, and how many pairs of half flights were joined for it."""

    pool: Pool
    pairs: int

    def size(self, delta: float) -> Size:
        """Return how large it is; no number is zero."""
        return Size(delta, max(1, self.pairs), max(1, len(self.pool)))


def affordable(sizes: Sequence[Size], flights: float, pairs: float) -> float:
    """Return up to which reduced cost a list is expected to be no longer than is said.

    Each unit more makes flights and pairs more by the same factor, as the last two lists tell; a
    little less, in fact. What was listed was not too long.
    """
    if len(sizes) < 2:
        return inf
    less, more = sizes[-2:]
    of_pairs = _extrapolated(less.delta, less.pairs, more.delta, more.pairs, pairs)
    of_flights = _extrapolated(less.delta, less.flights, more.delta, more.flights, flights)
    return max(more.delta, min(of_pairs, of_flights))


def times_longer(sizes: Sequence[Size], delta: float) -> float:
    """Return how many times the pairs of the last list one up to ``delta`` is expected to take."""
    if len(sizes) < 2:
        return 1.0
    less, more = sizes[-2:]
    if not (more.delta > less.delta and more.pairs > less.pairs):
        return 1.0
    times: float = (more.pairs / less.pairs) ** ((delta - more.delta) / (more.delta - less.delta))
    return times


def _extrapolated(less: float, few: int, more: float, many: int, number: float) -> float:
    """Return where there are ``number``, if ``few`` up to ``less`` and ``many`` up to ``more``."""
    if not (more > less and many > few):
        return inf
    return more + log(number / many) * (more - less) / log(many / few)


def list_flights(
    relaxation: Relaxation, fixing: Fixing, delta: float, effort: int, known: RowDuals | None
) -> Listing | None:
    """List all flights of plans that take less than ``fixing.value + delta`` and the best plan.

    Parameters
    ----------
    relaxation
        Whose legs, counts of flights and memory hold.
    fixing
        Tells what completes labels, and their prices.
    delta
        Reduced cost that no flight exceeds.
    effort
        As of :func:`~windopt.solving.exact.enumeration.enumerate_flights`.
    known
        The prices of the last list, None where there was none.

    Returns
    -------
    None where the flights are too many.

    Raises
    ------
    OutOfTime
        If time is up.
    ProofError
        If a flight of the best plan is missing that must be there.
    """
    search, counts = relaxation.search, relaxation.counts
    target = min(fixing.value + delta, search.ceiling)
    networks = fixing.useful(relaxation.pricer.networks, delta)
    screen = None if known is None else _screen(known, fixing, target, counts)
    while True:
        pool, pairs = enumerate_flights(
            networks, fixing, delta, effort, relaxation.memory, search.clock,
            apart=search.limited, screen=screen,
        )  # fmt: skip
        if pool is None:
            return None
        _require_plan(pool, fixing, delta, screen, relaxation)
        if screen is None:
            return Listing(pool, pairs)
        needed = _left(screen.prices, target, counts) + _below(screen.prices, pool, search)
        if needed <= screen.limit:
            return Listing(pool, pairs)
        search.note("screen widened from %.3f to %.3f", screen.limit, needed)
        del pool  # before room is made for another
        screen = replace(screen, limit=needed)


def _screen(known: RowDuals, fixing: Fixing, target: float, counts: Floats) -> Screen:
    """Return a screen that lets enough pass, if flights fall below zero by little."""
    prices = mixed(MIX, known, fixing.in_full)
    return Screen(prices, SPARE * _left(prices, target, counts))


def _left(prices: RowDuals, target: float, counts: Floats) -> float:
    """Return what prices leave up to a target."""
    return max(0.0, target - prices.duals.value(counts)) + MARGIN


def _below(prices: RowDuals, pool: Pool, search: Search) -> float:
    """Return how far flights of one plan fall below zero together, at most.

    Parameters
    ----------
    pool
        All flights that do, among others.
    """
    slices = pool.slices(search.n, search.clock)
    reduced = reduced_costs(pool, slices, *prices, search.clock)
    lower = reduced < 0.0
    return together_below(reduced[lower], pool.kept(lower).members(search.n))


def _require_plan(
    pool: Pool, fixing: Fixing, delta: float, screen: Screen | None, relaxation: Relaxation
) -> None:
    """Check that those flights of the best plan are in the pool which must be.

    Raises
    ------
    ProofError
        If one is not, or the prices of the screen prove that there is no such plan: then the
        search for flights loses some.
    """
    search, prices = relaxation.search, fixing.in_full
    for d, path in search.flights:
        time = search.networks[d].duration(path)
        within = prices.reduced_cost(d, path, time) <= delta
        if screen is not None:
            cost = screen.prices.reduced_cost(d, path, time)
            within = within and cost <= screen.limit - MARGIN
        if within and not pool.holds(path, time):
            raise ProofError(f"The flight {path} from station {d} is not in the pool.")
    if screen is None:
        return
    if _plan_value(screen.prices, relaxation.counts, search) > search.objective + TOLERATED:
        raise ProofError("The prices of the screen prove more than the best plan takes.")


def _plan_value(prices: RowDuals, counts: Floats, search: Search) -> float:
    """Return what prices prove the best plan to take: no more than it does, if they are right."""
    duals = prices.duals
    flown = [(d, path, search.networks[d].duration(path)) for d, path in search.flights]
    visited = [i for _, path, _ in flown for i in path]
    left_out = [i for i in range(search.n) if i not in visited]
    total = duals.value(counts) + float(search.prize[left_out].sum())
    total -= float((duals.pi + duals.reward @ duals.crowded.left_out)[left_out].sum())
    return total + sum(prices.reduced_cost(*each) for each in flown)
