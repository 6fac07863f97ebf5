"""Enumeration: all flights of a reduced cost below the gap, each set of turbines once.

Half flights are joined, and the flights hashed on their set, keeping the fastest over all
stations, or for each station where these may be short of flights. A plan cheaper than dual
bound + gap uses no other flight [1], and of these none that a screen leaves out.

* [1] Baldacci, Christofides & Mingozzi (2008), *Mathematical Programming* 115, 351-385.
"""

from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.completions import Completions
from windopt.solving.exact.fixing import Fixing
from windopt.solving.exact.half_flights import Halves, Interest, half_flights
from windopt.solving.exact.hashing import empty_slots
from windopt.solving.exact.joined_halves import Terms, join_halves
from windopt.solving.exact.kept_flights import Sets
from windopt.solving.exact.labels import Ints, Labels, Memory, Prices, turned
from windopt.solving.exact.list_prices import ListPrices, looked_at
from windopt.solving.exact.network import Floats, Network, Side
from windopt.solving.exact.parities import grouped, parities
from windopt.solving.exact.pool import Pool, Tree
from windopt.solving.exact.screening import Screen

HALVES_SHARE, FLIGHTS_SHARE = 0.25, 0.35
"""Shares of the memory that half flights and flights may take."""
HALF_BYTES = 64
"""Memory of one half flight, without its set and the parities of its cuts."""
UNEVEN = 0.6
"""Part of the flights that may be of one parity."""
JOINED = 4
"""Flights to hold for each half flight allowed."""
PAIRS = 16
"""Pairs of halves to join for each half flight allowed, where most flights are left out."""
NO_LIMIT = 2**62
BUCKETS = 24
"""Time buckets of half flights in a t_max; few, since each is sorted by cost."""


def enumerate_flights(
    networks: list[Network],
    fixing: Fixing,
    gap: float,
    effort: int,
    memory: float,
    clock: Clock,
    *,
    apart: bool = False,
    screen: Screen | None = None,
) -> tuple[Pool | None, int]:
    """Return the flights of a reduced cost up to ``gap``; None where they are too many.

    Parameters
    ----------
    networks
        Without the legs of dearer flights.
    effort, memory
        Half flights to hold at most, for one side of one station, a :data:`JOINED`-th of the
        flights, and where they are screened a :data:`PAIRS`-th of the pairs that are joined; and
        what half flights and flights may take [bytes].
    apart
        Whether to keep a flight over each set for each station, not the fastest only.
    screen
        Leaves out flights that it finds too dear.

    Returns
    -------
    The list, and how many pairs of halves were joined for it.
    """
    n, prices = len(networks[0].out), fixing.prices
    list_prices = ListPrices.of(screen.prices if screen else None, n)
    found, half_capacity = _nothing_found(n, prices.inside.shape[1], effort, memory)
    trees = []
    for d, (network, rest) in enumerate(zip(networks, fixing.completions, strict=True)):
        network, limit = network.granted(fixing.duals.grant), float(fixing.limits(gap)[d])
        halves = _both_halves(network, prices, fixing.memory, rest, limit, half_capacity, clock)
        if halves is None:
            return None, 0
        screened = inf if screen is None else screen.limit + float(screen.prices.duals.toll[d])
        most = NO_LIMIT if screen is None else int(UNEVEN * PAIRS * effort)
        width = network.t_max / BUCKETS
        terms = Terms(d, network.t_max, network.half, limit, screened, most, width, apart)
        if not _add_flights(found, *halves, network.forward, prices, list_prices, terms, clock):
            return None, _pairs(found)
        forward, backward = halves
        trees.append((Tree(forward.node, forward.parent), Tree(backward.node, backward.parent)))
    return _pool(found, trees), _pairs(found)


def most_flights(n: int, effort: int, memory: float) -> int:
    """Return how many flights may be listed, over n turbines, if they are even enough."""
    words = (n + 63) // 64
    most = FLIGHTS_SHARE * memory / (60 + 16 * words + n / 4) / (2 * UNEVEN)
    return min(JOINED * effort, int(most))


@dataclass
class _Found:
    """Flights of one parity, and their hash table."""

    sets: Sets
    slots: Ints
    count: int = 0
    joined: int = 0


def _pairs(found: list[_Found]) -> int:
    return sum(each.joined for each in found)


def _nothing_found(n: int, cuts: int, effort: int, memory: float) -> tuple[list[_Found], int]:
    """Make room for flights of each parity, and return how many half flights a side may have."""
    words = (n + 63) // 64
    each = HALF_BYTES + 8 * (words + cuts)
    halves = min(effort, int(HALVES_SHARE * memory / (3 * each)))  # backward ones are held twice
    rows = 1 + int(UNEVEN * most_flights(n, effort, memory))

    def room() -> _Found:
        station, ahead, behind = (np.empty(rows, np.int32) for _ in range(3))
        sets = Sets(np.empty(rows), station, ahead, behind, np.empty((rows, words), np.uint64))
        return _Found(sets, empty_slots(1 << 16))

    return [room(), room()], halves


def _add_flights(
    found: list[_Found],
    forward: Halves,
    backward: Halves,
    side: Side,
    prices: Prices,
    list_prices: ListPrices,
    terms: Terms,
    clock: Clock,
) -> bool:
    """Add the flights of one station, both parities side by side; tell whether all fitted."""
    odd_ahead, odd_behind = parities(forward), parities(backward)
    order, groups = grouped(backward, odd_behind, len(side.first), BUCKETS, terms.width)
    backward, odd_behind = backward.at(order), odd_behind[order]
    ahead, behind = clock.map(looked_at, (forward, backward), (list_prices, list_prices))

    def add(parity: int, each: _Found) -> bool:
        each.slots, each.count, each.joined, whole = join_halves(
            forward, backward, ahead, behind, odd_ahead, odd_behind, parity, order, groups, side,
            prices, list_prices, terms, each.sets, each.slots, each.count, each.joined, clock.stop,
        )  # fmt: skip
        return whole

    return all(clock.map(add, (0, 1), found))


def _pool(found: list[_Found], trees: list[tuple[Tree, Tree]]) -> Pool:
    """Return copies of the flights in use."""

    def joined(field: str) -> NDArray[Any]:
        return np.concatenate([getattr(each.sets, field)[: each.count] for each in found])

    cost, station, ahead, behind, sets = map(joined, Sets._fields)
    return Pool(cost, station, ahead, behind, sets, trees)


def _both_halves(
    network: Network,
    prices: Prices,
    memory: Memory,
    rest: Completions,
    limit: float,
    capacity: int,
    clock: Clock,
) -> tuple[Halves, Halves] | None:
    """Return the forward and backward half flights, None where there are too many."""

    def halves(side: Side, prices: Prices, table: Floats, ends: Labels) -> tuple[Halves, bool]:
        interest = Interest(network.t_max, network.half, limit, rest.step)
        return half_flights(side, prices, memory, interest, table, ends, capacity, clock.stop)

    sides, tables = (network.forward, network.backward), (rest.forward, rest.backward)
    ends = (rest.behind, rest.ahead)
    (forward, whole), (backward, whole_too) = clock.map(
        halves, sides, (prices, turned(prices)), tables, ends
    )
    return (forward, backward) if whole and whole_too else None
