"""Enumeration: all flights of a reduced cost below the gap, each set of turbines once.

Half flights are joined, and the flights hashed on their set, keeping the fastest over all
stations, or for each station where these may be short of flights. A plan cheaper than dual
bound + gap uses no other flight [1].

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
from windopt.solving.exact.joined_halves import Parities, Sets, Terms, join_halves, parities
from windopt.solving.exact.labels import Ints, Labels, Memory, Prices, turned
from windopt.solving.exact.network import Floats, Network, Side
from windopt.solving.exact.pool import Pool, Tree
from windopt.solving.exact.screening import ListPrices, Screen, looked_at

HALVES_SHARE, FLIGHTS_SHARE = 0.25, 0.35
"""Shares of the memory that half flights and flights may take."""
UNEVEN = 0.6
"""Part of the flights that may be of one parity."""
JOINED = 4
"""Flights to hold for each half flight allowed."""
MADE = 16
"""Flights to make for each half flight allowed, where most of them are left out."""
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
    """Return all flights of a reduced cost up to ``gap``; None where they are too many.

    Parameters
    ----------
    networks
        Without the legs of dearer flights.
    effort, memory
        Half flights to hold at most, for one side of one station, and a :data:`JOINED`-th of
        the flights; and what these may take [bytes].
    apart
        Whether to keep a flight over each set for each station, not the fastest only.
    screen
        Leaves out flights that it finds too dear.

    Returns
    -------
    The list, and how many flights were made for it: several over a set, and those left out.
    """
    n, prices = len(networks[0].out), fixing.prices
    list_prices = ListPrices.of(screen, n)
    found, half_capacity = _nothing_found(n, prices.inside.shape[1], effort, memory)
    trees = []
    for d, (network, rest) in enumerate(zip(networks, fixing.completions, strict=True)):
        network, limit = network.granted(fixing.duals.grant), float(fixing.limits(gap)[d])
        halves = _both_halves(network, prices, fixing.memory, rest, limit, half_capacity, clock)
        if halves is None:
            return None, 0
        terms = Terms(
            d,
            network.t_max,
            network.half,
            limit,
            inf if screen is None else screen.limit + float(screen.prices.duals.toll[d]),
            int(UNEVEN * most_made(effort, screened=screen is not None)),
            network.t_max / BUCKETS,
            apart,
        )
        given = prices, list_prices, terms
        if not _add_flights(found, *halves, network.forward, *given, clock):
            return None, _made(found)
        forward, backward = halves
        trees.append((Tree(forward.node, forward.parent), Tree(backward.node, backward.parent)))
    return _pool(found, trees), _made(found)


def most_made(effort: int, *, screened: bool) -> int:
    """Return how many flights may be made, if they are even enough."""
    return (MADE if screened else 4 * JOINED) * effort


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
    made: int = 0


def _made(found: list[_Found]) -> int:
    return sum(each.made for each in found)


def _nothing_found(n: int, cuts: int, effort: int, memory: float) -> tuple[list[_Found], int]:
    """Make room for flights of each parity, and return how many half flights a side may have."""
    words = (n + 63) // 64
    halves = min(effort, int(HALVES_SHARE * memory / (2 * (48 + 8 * (words + cuts)))))
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
    odd = parities(forward), parities(backward)
    order, groups = _grouped(backward, odd[1], len(side.first), terms.width)
    backward = Halves(*(each[order] for each in backward))
    odd = odd[0], odd[1][order]
    looks = clock.map(looked_at, (forward, backward), (list_prices, list_prices))

    def add(parity: int, each: _Found) -> bool:
        each.slots, each.count, each.made, whole = join_halves(
            forward, backward, *looks, *odd, parity, order, groups, side, prices, list_prices,
            terms, each.sets, each.slots, each.count, each.made, clock.stop,
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


def _grouped(
    found: Halves, parity: Parities, n: int, width: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sort halves, even ones first, by turbine, time bucket and cost.

    Returns
    -------
    The order, and where each group of one parity, turbine and bucket begins.
    """
    bucket = (found.T / width).astype(np.int64)
    group = (parity.astype(np.int64) * n + found.node) * BUCKETS + bucket
    order = np.lexsort((found.C, group))
    begin = np.searchsorted(group[order], np.arange(2 * n * BUCKETS + 1))
    return order, begin.astype(np.int64)
