"""Enumeration: all flights of a reduced cost below the gap, each set of turbines once.

Half flights of all elementary orders are hashed on their last turbine and their set, keeping the
fastest, and pruned by the completion tables; joined, they are hashed on their set alone, keeping
the fastest over all stations. A plan cheaper than dual bound + gap uses no other flight [1]_.

.. [1] Baldacci, Christofides & Mingozzi (2008), *Mathematical Programming* 115, 351-385.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.arc_fixing import Completions
from windopt.solving.exact.bits import NONE, ONE, bit
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.joins import cheapest, partner
from windopt.solving.exact.labels import EPS, Ints, Labels, Memory, Prices, Words, price_of
from windopt.solving.exact.network import SLACK, Floats, Network, Side
from windopt.solving.exact.ng_neighbourhoods import WIDEST
from windopt.solving.exact.pool import Pool, Tree
from windopt.solving.exact.relaxation import Fixing

HALVES_SHARE, FLIGHTS_SHARE = 0.3, 0.4
"""Shares of the memory that half flights and flights may take."""
JOINED = 4
"""Flights to allow for each half flight allowed."""
BUCKETS = 24
"""Time buckets of half flights in a t_max; few, since each is sorted by cost."""


class Halves(NamedTuple):
    """Elementary half flights: time, cost, last turbine, parent, set and parities."""

    T: Floats
    C: Floats
    node: Ints
    parent: Ints
    set: Words
    S: Words


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
def _hash(words: Words, row: int, salt: int) -> np.uint64:
    """Mix a row of words."""
    mixed = np.uint64(salt) * np.uint64(0xC2B2AE3D27D4EB4F)
    for word in range(words.shape[1]):
        mixed ^= words[row, word]
        mixed ^= mixed >> np.uint64(29)
        mixed *= np.uint64(0xBF58476D1CE4E5B9)
        mixed ^= mixed >> np.uint64(32)
        mixed *= np.uint64(0x94D049BB133111EB)
    return mixed ^ (mixed >> np.uint64(31))


@compiled
def _same(words: Words, a: int, b: int) -> bool:
    differing = NONE
    for word in range(words.shape[1]):
        differing |= words[a, word] ^ words[b, word]
    return bool(differing == NONE)


@compiled
def _slots(size: int) -> Ints:
    return np.full(size, -1, np.int32)


@compiled
def _find(slots: Ints, found: Halves, new: int, j: int) -> np.uint64:
    """Return the slot of row ``new`` of ``found``, which ends at j."""
    mask = np.uint64(len(slots) - 1)
    slot = _hash(found.set, new, j + 1) & mask
    while slots[slot] >= 0:
        if found.node[slots[slot]] == j and _same(found.set, slots[slot], new):
            break
        slot = (slot + ONE) & mask
    return slot


@compiled
def _remembered(sets: Words, row: int, j: int, memory: Memory) -> np.uint64:
    """Return the turbines of a set that j remembers, in j's numbers."""
    V = NONE
    for position in range(WIDEST):
        bit_here = ONE << np.uint64(position)
        i = memory.member[j, position]
        if memory.bit[j, i] == bit_here and sets[row, i >> 6] & bit(i) != NONE:
            V |= bit_here
    return V


@compiled
def half_flights(
    side: Side,
    prices: Prices,
    rest: Floats,
    step: float,
    ends: Labels,
    memory: Memory,
    t_max: float,
    horizon: float,
    limit: float,
    capacity: int,
    stop: NDArray[np.uint8],
) -> tuple[Halves, bool]:
    """Find the elementary half flights that may be part of a flight of cost ``limit`` or less.

    They come in order of size, so that a half flight is final before it is extended.

    Parameters
    ----------
    rest, step
        Table of completion costs, a quick test.
    ends
        Labels from the other end, a thorough one: one of them must complete the half flight
        without returning to it as far as it remembers.

    Returns
    -------
    The :class:`Halves`, and whether they are complete.
    """
    n, words = prices.memory.shape
    width = (n + 63) // 64
    found = Halves(
        np.empty(capacity + 1),
        np.empty(capacity + 1),
        np.empty(capacity + 1, np.int32),
        np.empty(capacity + 1, np.int32),
        np.empty((capacity + 1, width), np.uint64),
        np.empty((capacity + 1, words), np.uint64),
    )
    slots = _slots(1 << 16)
    least = cheapest(ends)
    count, current = 0, -1
    parities = np.empty(words, np.uint64)
    complete = True
    while current < count and complete:
        if stop[0] != 0:
            complete = False
            break
        i = found.node[current] if current >= 0 else -1
        for e in range(side.degree[i] if i >= 0 else n):
            j = side.heads[i, e] if i >= 0 else e
            if i >= 0:
                if found.set[current, j >> 6] & bit(j) != NONE:
                    continue
                leg = side.legs[i, j]
                t, c = found.T[current] + leg, found.C[current] + leg - prices.pi[j]
            else:
                t, c = side.first[j], side.first[j] - prices.pi[j]
            if t > horizon or t + side.rest[j] > t_max + SLACK:
                continue
            for word in range(words):
                kept = prices.memory[j, word] & (found.S[current, word] if i >= 0 else NONE)
                c += price_of(kept & prices.inside[j, word], word, prices.penalty)
                parities[word] = kept ^ prices.inside[j, word]
            if c + rest[j, int((t_max - t + SLACK) / step)] > limit:
                continue
            left = t_max - t + SLACK
            if i >= 0:
                V = _remembered(found.set, current, j, memory)
                below = limit - found.C[current] - side.legs[i, j] + EPS
                _, end = partner(
                    ends, least, j, V, found.S, current, left, below, below, prices.penalty
                )
                if end < 0:
                    continue
            for word in range(width):
                found.set[count, word] = found.set[current, word] if i >= 0 else NONE
            found.set[count, j >> 6] |= bit(j)
            slot = _find(slots, found, count, j)
            row = slots[slot]
            if row >= 0:
                if found.T[row] <= t:
                    continue
            elif count == capacity:
                complete = False
                break
            else:
                row = count
                slots[slot] = count
                count += 1
            found.T[row], found.C[row], found.node[row], found.parent[row] = t, c, j, current
            found.S[row] = parities
            if 2 * count > len(slots):
                slots = _slots(4 * len(slots))
                for old in range(count):
                    slots[_find(slots, found, old, found.node[old])] = old
        current += 1
    return (
        Halves(
            found.T[:count].copy(),
            found.C[:count].copy(),
            found.node[:count].copy(),
            found.parent[:count].copy(),
            found.set[:count].copy(),
            found.S[:count].copy(),
        ),
        complete,
    )


@compiled
def _slot(slots: Ints, sets: Sets, row: int) -> np.uint64:
    """Return the slot of the turbines in ``row``."""
    mask = np.uint64(len(slots) - 1)
    slot = _hash(sets.set, row, 0) & mask
    while slots[slot] >= 0 and not _same(sets.set, slots[slot], row):
        slot = (slot + ONE) & mask
    return slot


@compiled
def _record(
    sets: Sets, slots: Ints, count: int, cost: float, d: int, ahead: int, behind: int
) -> tuple[Ints, int]:
    """Keep the flight whose turbines are in row ``count`` if it is the fastest of its set.

    Returns the hash table and the number of flights in use.
    """
    slot = _slot(slots, sets, count)
    row = slots[slot]
    if row < 0:
        row = slots[slot] = count
        count += 1
        if 2 * count > len(slots):
            slots = _slots(4 * len(slots))
            for old in range(count):
                slots[_slot(slots, sets, old)] = old
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
            slots, count = _record(sets, slots, count, whole, d, -1, b)
    for f in range(len(forward.T)):
        if stop[0] != 0:
            return slots, count, False
        i = forward.node[f]
        whole = forward.T[f] + side.last[i]
        if forward.C[f] + side.last[i] <= limit and whole <= t_max + SLACK:
            if count == capacity:
                return slots, count, False
            _union(sets, count, forward.set, f, backward.set, -1)
            slots, count = _record(sets, slots, count, whole, d, f, -1)
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
                    slots, count = _record(sets, slots, count, t + backward.T[b], d, f, b)
    return slots, count, True


def enumerate_flights(
    networks: list[Network], fixing: Fixing, gap: float, effort: int, memory: float, clock: Clock
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
    slots, count = _slots(1 << 16), 0
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
            [sets], [slots], [count], [d], [clock.stop],
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
