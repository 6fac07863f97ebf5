"""Enumeration: all flights of a reduced cost below the gap, each set of turbines once.

Half flights are joined, and the flights hashed on their set, keeping the fastest over all
stations, or for each station where these may be short of flights. A plan cheaper than dual
bound + gap uses no other flight [1].

* [1] Baldacci, Christofides & Mingozzi (2008), *Mathematical Programming* 115, 351-385.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.arc_fixing import Completions
from windopt.solving.exact.bits import NONE, ONE, bit
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.half_flights import Halves, half_flights
from windopt.solving.exact.hashing import empty_slots, row_hash, same_rows
from windopt.solving.exact.labels import Ints, Labels, Memory, Prices, Words, price_of
from windopt.solving.exact.network import SLACK, Floats, Network, Side
from windopt.solving.exact.pool import Pool, Tree
from windopt.solving.exact.relaxation import Fixing

HALVES_SHARE, FLIGHTS_SHARE = 0.3, 0.4
"""Shares of the memory that half flights and flights may take."""
JOINED = 4
"""Flights to allow for each half flight allowed."""
BUCKETS = 24
"""Time buckets of half flights in a t_max; few, since each is sorted by cost."""


class Sets(NamedTuple):
    """Flights, one per set of turbines; the arrays are larger than the flights in use.

    Attributes
    ----------
    cost, station, ahead, behind
        Of each flight: its time, its station, and the halves it is joined from, or -1.
    set
        Its turbines as bits; the row after the last in use is scratch.
    """

    cost: Floats
    station: Ints
    ahead: Ints
    behind: Ints
    set: Words


@compiled
def _slot(slots: Ints, sets: Sets, row: int, apart: bool) -> np.uint64:
    """Return the slot of the turbines in ``row``, and of its station where these are ``apart``."""
    mask = np.uint64(len(slots) - 1)
    slot = row_hash(sets.set, row, sets.station[row] if apart else 0) & mask
    while slots[slot] >= 0:
        other = slots[slot]
        alike = not apart or sets.station[other] == sets.station[row]
        if alike and same_rows(sets.set, other, row):
            break
        slot = (slot + ONE) & mask
    return slot


@compiled
def _record(
    sets: Sets, slots: Ints, count: int, cost: float, d: int, ahead: int, behind: int, apart: bool
) -> tuple[Ints, int]:
    """Keep the flight whose turbines are in row ``count`` if it is the fastest of its set.

    Returns the hash table and the number of flights in use.
    """
    sets.station[count] = d
    slot = _slot(slots, sets, count, apart)
    row = slots[slot]
    if row < 0:
        row = slots[slot] = count
        count += 1
        if 2 * count > len(slots):
            slots = empty_slots(4 * len(slots))
            for old in range(count):
                slots[_slot(slots, sets, old, apart)] = old
    elif sets.cost[row] <= cost:
        return slots, count
    sets.cost[row], sets.station[row], sets.ahead[row], sets.behind[row] = cost, d, ahead, behind
    return slots, count


@compiled
def _union(sets: Sets, count: int, a: Words, i: int, b: Words, j: int) -> None:
    """Write the turbines of two halves, or of one where j < 0, into row ``count``."""
    for word in range(sets.set.shape[1]):
        sets.set[count, word] = a[i, word] | (b[j, word] if j >= 0 else NONE)


@compiled
def _disjoint(a: Words, i: int, b: Words, j: int) -> bool:
    common = NONE
    for word in range(a.shape[1]):
        common |= a[i, word] & b[j, word]
    return bool(common == NONE)


@compiled
def join_halves(
    forward: Halves,
    backward: Halves,
    order: NDArray[np.int64],
    groups: NDArray[np.int64],
    width: float,
    side: Side,
    penalty: Floats,
    t_max: float,
    half: float,
    limit: float,
    sets: Sets,
    slots: Ints,
    count: int,
    d: int,
    apart: bool,
    stop: NDArray[np.uint8],
) -> tuple[Ints, int, bool]:
    """Add the flights of station d of cost ``limit`` or less to ``sets``.

    Parameters
    ----------
    order, groups
        Backward halves, cheapest first within each turbine and time bucket of ``width``:
        bucket b of turbine j is ``order[groups[j * buckets + b] : groups[j * buckets + b + 1]]``.

    slots
        Hash table of the flights in ``sets``, a power of two long: rows, or -1.
    apart
        Whether to keep a flight over each set for each station.

    Returns
    -------
    The hash table, the number of flights in ``sets``, and whether all fitted.
    """
    buckets = (len(groups) - 1) // len(side.first)
    capacity = len(sets.cost) - 1
    for b in range(len(backward.T)):
        first = side.first[backward.node[b]]
        whole = first + backward.T[b]
        if first > half and whole <= t_max + SLACK and backward.C[b] + first <= limit:
            if count == capacity:
                return slots, count, False
            _union(sets, count, backward.set, b, backward.set, -1)
            slots, count = _record(sets, slots, count, whole, d, -1, b, apart)
    for f in range(len(forward.T)):
        if stop[0] != 0:
            return slots, count, False
        i = forward.node[f]
        whole = forward.T[f] + side.last[i]
        if forward.C[f] + side.last[i] <= limit and whole <= t_max + SLACK:
            if count == capacity:
                return slots, count, False
            _union(sets, count, forward.set, f, backward.set, -1)
            slots, count = _record(sets, slots, count, whole, d, f, -1, apart)
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            t, c = forward.T[f] + side.legs[i, j], forward.C[f] + side.legs[i, j]
            left = t_max - t + SLACK
            if t <= half or left < 0.0 or forward.set[f, j >> 6] & bit(j) != NONE:
                continue
            for group in range(min(buckets, int(left / width) + 1)):
                start = groups[j * buckets + group]
                for b in order[start : groups[j * buckets + group + 1]]:
                    cost = c + backward.C[b]
                    if cost > limit:
                        break
                    if backward.T[b] > left or not _disjoint(forward.set, f, backward.set, b):
                        continue
                    for word in range(len(penalty) // 64):
                        cost += price_of(forward.S[f, word] & backward.S[b, word], word, penalty)
                    if cost > limit:
                        continue
                    if count == capacity:
                        return slots, count, False
                    _union(sets, count, forward.set, f, backward.set, b)
                    t_whole = t + backward.T[b]
                    slots, count = _record(sets, slots, count, t_whole, d, f, b, apart)
    return slots, count, True


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
    """Return all flights of a reduced cost up to ``gap``.

    Parameters
    ----------
    networks
        Without the legs of dearer flights.
    effort
        Half flights to hold at most, for one side of one station, and a :data:`JOINED`-th of
        the flights.
    memory
        What half flights and flights may take [bytes].
    apart
        Whether to keep a flight over each set for each station, not the fastest only.

    Returns
    -------
    The flights; None where memory does not suffice.
    """
    n, prices = len(networks[0].out), fixing.prices
    words, cuts = (n + 63) // 64, prices.memory.shape[1]
    half_capacity = min(effort, int(HALVES_SHARE * memory / (2 * (48 + 8 * (words + cuts)))))
    flight_capacity = min(JOINED * effort, int(FLIGHTS_SHARE * memory / (60 + 16 * words + n / 4)))
    sets = Sets(
        np.empty(flight_capacity + 1),
        np.empty(flight_capacity + 1, np.int32),
        np.empty(flight_capacity + 1, np.int32),
        np.empty(flight_capacity + 1, np.int32),
        np.empty((flight_capacity + 1, (n + 63) // 64), np.uint64),
    )
    slots, count = empty_slots(1 << 16), 0
    trees = []
    for d, (network, rest) in enumerate(zip(networks, fixing.completions, strict=True)):
        limit = float(fixing.limits(gap)[d])
        halves = _both_halves(network, prices, fixing.memory, rest, limit, half_capacity, clock)
        if halves is None:
            return None
        forward, backward = halves
        width = network.t_max / BUCKETS
        order, groups = _grouped(backward, n, width)
        [(slots, count, whole)] = clock.map(
            join_halves,
            [forward], [backward], [order], [groups], [width], [network.forward],
            [prices.penalty], [network.t_max], [network.half], [limit],
            [sets], [slots], [count], [d], [apart], [clock.stop],
        )  # fmt: skip
        if not whole:
            return None
        trees.append((Tree(forward.node, forward.parent), Tree(backward.node, backward.parent)))
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

    def halves(side: Side, table: Floats, ends: Labels) -> tuple[Halves, bool]:
        return half_flights(
            side, prices, table, rest.step, ends, memory, network.t_max, network.half, limit,
            capacity, clock.stop,
        )  # fmt: skip

    sides, tables = (network.forward, network.backward), (rest.forward, rest.backward)
    ends = (rest.behind, rest.ahead)
    (forward, whole), (backward, whole_too) = clock.map(halves, sides, tables, ends)
    return (forward, backward) if whole and whole_too else None


def _grouped(found: Halves, n: int, width: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sort halves by turbine, time bucket and cost; return the order and where groups begin."""
    group = found.node.astype(np.int64) * BUCKETS + (found.T / width).astype(np.int64)
    order = np.lexsort((found.C, group))
    return order, np.searchsorted(group[order], np.arange(n * BUCKETS + 1)).astype(np.int64)
