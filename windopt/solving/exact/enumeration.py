"""Enumeration: all flights of a reduced cost below the gap, each set of turbines once.

Half flights are joined, and the flights hashed on their set, keeping the fastest over all
stations, or for each station where these may be short of flights. A plan cheaper than dual
bound + gap uses no other flight [1].

* [1] Baldacci, Christofides & Mingozzi (2008), *Mathematical Programming* 115, 351-385.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.completions import Completions
from windopt.solving.exact.fixing import Fixing
from windopt.solving.exact.half_flights import Halves, Interest, half_flights
from windopt.solving.exact.hashing import empty_slots
from windopt.solving.exact.joined_halves import Sets, Terms, join_halves
from windopt.solving.exact.labels import Labels, Memory, Prices, turned
from windopt.solving.exact.network import Floats, Network, Side
from windopt.solving.exact.pool import Pool, Tree

HALVES_SHARE, FLIGHTS_SHARE = 0.25, 0.35
"""Shares of the memory that half flights and flights may take."""
JOINED = 4
"""Flights to allow for each half flight allowed."""
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
) -> Pool | None:
    """Return all flights of a reduced cost up to ``gap``; None where memory does not suffice.

    Parameters
    ----------
    networks
        Without the legs of dearer flights.
    effort, memory
        Half flights to hold at most, for one side of one station, and a :data:`JOINED`-th of
        the flights; and what these may take [bytes].
    apart
        Whether to keep a flight over each set for each station, not the fastest only.
    """
    n, prices = len(networks[0].out), fixing.prices
    sets, half_capacity = _empty_sets(n, prices.inside.shape[1], effort, memory)
    slots, count = empty_slots(1 << 16), 0
    trees = []
    for d, (network, rest) in enumerate(zip(networks, fixing.completions, strict=True)):
        network, limit = network.granted(fixing.duals.grant), float(fixing.limits(gap)[d])
        halves = _both_halves(network, prices, fixing.memory, rest, limit, half_capacity, clock)
        if halves is None:
            return None
        forward, backward = halves
        terms = Terms(d, network.t_max, network.half, limit, network.t_max / BUCKETS, apart)
        order, groups = _grouped(backward, n, terms.width)
        [(slots, count, whole)] = clock.map(
            join_halves,
            [forward], [backward], [order], [groups], [network.forward], [prices],
            [terms], [sets], [slots], [count], [clock.stop],
        )  # fmt: skip
        if not whole:
            return None
        trees.append((Tree(forward.node, forward.parent), Tree(backward.node, backward.parent)))
    return _pool(sets, count, trees)


def most_flights(n: int, effort: int, memory: float) -> int:
    """Return how many flights may be listed, over n turbines."""
    words = (n + 63) // 64
    return min(JOINED * effort, int(FLIGHTS_SHARE * memory / (60 + 16 * words + n / 4)))


def _empty_sets(n: int, cuts: int, effort: int, memory: float) -> tuple[Sets, int]:
    """Make room for flights, and return the half flights of one side there may be."""
    words = (n + 63) // 64
    halves = min(effort, int(HALVES_SHARE * memory / (2 * (48 + 8 * (words + cuts)))))
    rows = 1 + most_flights(n, effort, memory)
    station, ahead, behind = (np.empty(rows, np.int32) for _ in range(3))
    return Sets(np.empty(rows), station, ahead, behind, np.empty((rows, words), np.uint64)), halves


def _pool(sets: Sets, count: int, trees: list[tuple[Tree, Tree]]) -> Pool:
    """Return copies of the flights in use."""
    return Pool(
        sets.cost[:count].copy(),
        sets.station[:count].copy(),
        sets.ahead[:count].copy(),
        sets.behind[:count].copy(),
        sets.set[:count].copy(),
        trees,
    )


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


def _grouped(found: Halves, n: int, width: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sort halves by turbine, time bucket and cost; return the order and where groups begin."""
    group = found.node.astype(np.int64) * BUCKETS + (found.T / width).astype(np.int64)
    order = np.lexsort((found.C, group))
    return order, np.searchsorted(group[order], np.arange(n * BUCKETS + 1)).astype(np.int64)
