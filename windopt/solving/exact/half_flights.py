"""Half flights: all elementary ones that may be part of a flight of interest.

They are hashed on their last turbine and their set, keeping the fastest, and dropped when no label
from the other end completes them below the limit.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, bit
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.hashing import empty_slots, row_hash, same_rows
from windopt.solving.exact.joins import cheapest, partner
from windopt.solving.exact.labels import (
    EPS,
    Ints,
    Labels,
    Memory,
    Prices,
    Words,
    price_of,
    recalled,
)
from windopt.solving.exact.network import SLACK, Floats, Side
from windopt.solving.exact.ng_neighbourhoods import WIDEST


class Halves(NamedTuple):
    """Elementary half flights: time, cost, last turbine, parent, set and parities."""

    T: Floats
    C: Floats
    node: Ints
    parent: Ints
    set: Words
    S: Words

    def at(self, rows: NDArray[np.int64]) -> "Halves":
        """Return the half flights ``rows``; parents still name rows of these."""
        return Halves(*(each[rows] for each in self))  # type: ignore[arg-type]


class Interest(NamedTuple):
    """What flights of interest keep to.

    Attributes
    ----------
    t_max, horizon
        Longest flight and longest half flight.
    limit
        Reduced cost that none exceeds.
    step
        Width of a step in tables of completion costs.
    """

    t_max: float
    horizon: float
    limit: float
    step: float


@compiled
def _find(slots: Ints, found: Halves, new: int, j: int) -> np.uint64:
    """Return the slot of row ``new`` of ``found``, which ends at j."""
    mask = np.uint64(len(slots) - 1)
    slot = row_hash(found.set, new, j + 1) & mask
    while slots[slot] >= 0:
        if found.node[slots[slot]] == j and same_rows(found.set, slots[slot], new):
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
def _empty_halves(capacity: int, n: int, words: int) -> Halves:
    """Make room for half flights, and for one to be looked at."""
    return Halves(
        np.empty(capacity + 1),
        np.empty(capacity + 1),
        np.empty(capacity + 1, np.int32),
        np.empty(capacity + 1, np.int32),
        np.empty((capacity + 1, (n + 63) // 64), np.uint64),
        np.empty((capacity + 1, words), np.uint64),
    )


@compiled
def _in_use(found: Halves, count: int) -> Halves:
    """Return copies of the rows in use."""
    return Halves(
        found.T[:count].copy(),
        found.C[:count].copy(),
        found.node[:count].copy(),
        found.parent[:count].copy(),
        found.set[:count].copy(),
        found.S[:count].copy(),
    )


@inlined
def _in_time(side: Side, interest: Interest, j: int, t: float) -> bool:
    """Tell whether a half flight may be done at j at time t."""
    return bool(t <= interest.horizon and t + side.rest[j] <= interest.t_max + SLACK)


@inlined
def _keep(
    found: Halves, slots: Ints, count: int, parent: int, j: int, t: float, c: float, S: Words
) -> tuple[Ints, int, bool]:
    """Keep ``parent`` flown on to j, unless a half flight over the same turbines is as fast.

    Returns the hash table, the number of half flights, and whether there was room.
    """
    for word in range(found.set.shape[1]):
        found.set[count, word] = found.set[parent, word] if parent >= 0 else NONE
    found.set[count, j >> 6] |= bit(j)
    slot = _find(slots, found, count, j)
    row = slots[slot]
    if row >= 0 and found.T[row] <= t:
        return slots, count, True
    if row < 0:
        if count == len(found.T) - 1:
            return slots, count, False
        row = slots[slot] = count
        count += 1
    found.T[row], found.C[row], found.node[row], found.parent[row] = t, c, j, parent
    found.S[row] = S
    if 2 * count > len(slots):
        slots = empty_slots(4 * len(slots))
        for old in range(count):
            slots[_find(slots, found, old, found.node[old])] = old
    return slots, count, True


@compiled
def _start(
    found: Halves, slots: Ints, side: Side, prices: Prices, interest: Interest, rest: Floats
) -> tuple[Ints, int, bool]:
    """Fly from the station to each turbine."""
    count, fitted = 0, True
    for j in range(len(side.first)):
        t, c = side.first[j], side.first_cost[j] - prices.pi[j]
        if fitted and _in_time(side, interest, j, t):
            left = interest.t_max - t + SLACK
            if c + rest[j, int(left / interest.step)] <= interest.limit:
                slots, count, fitted = _keep(found, slots, count, -1, j, t, c, prices.inside[j])
    return slots, count, fitted


@inlined
def _extend(
    found: Halves,
    slots: Ints,
    count: int,
    current: int,
    side: Side,
    prices: Prices,
    memory: Memory,
    interest: Interest,
    rest: Floats,
    ends: Labels,
    least: Floats,
    kept: Words,
    S: Words,
) -> tuple[Ints, int, bool]:
    """Fly on from half flight ``current``."""
    i = found.node[current]
    for e in range(side.degree[i]):
        j = side.heads[i, e]
        t, so_far = found.T[current] + side.legs[i, j], found.C[current] + side.legs_cost[i, j]
        visited = found.set[current, j >> 6] & bit(j) != NONE
        if visited or not _in_time(side, interest, j, t):
            continue
        c = so_far - prices.pi[j]
        recalled(found.S, current, prices, i, j, kept)
        for word in range(len(S)):
            c += price_of(kept[0, word] & prices.inside[j, word], word, prices.penalty)
            S[word] = kept[0, word] ^ prices.inside[j, word]
        left = interest.t_max - t + SLACK
        if c + rest[j, int(left / interest.step)] > interest.limit:
            continue
        V = _remembered(found.set, current, j, memory)
        below = interest.limit - so_far + EPS
        _, end = partner(ends, least, j, V, kept, 0, left, below, below, prices.penalty)
        if end >= 0:
            slots, count, fitted = _keep(found, slots, count, current, j, t, c, S)
            if not fitted:
                return slots, count, False
    return slots, count, True


@compiled
def half_flights(
    side: Side,
    prices: Prices,
    memory: Memory,
    interest: Interest,
    rest: Floats,
    ends: Labels,
    capacity: int,
    stop: NDArray[np.uint8],
) -> tuple[Halves, bool]:
    """Find the elementary half flights that may be part of a flight of interest.

    They come in order of size, so that a half flight is final before it is extended.

    Parameters
    ----------
    rest
        Table of completion costs, a quick test.
    ends
        Labels from the other end, a thorough one: one of them must complete the half flight
        without returning to it as far as it remembers.

    Returns
    -------
    The :class:`Halves`, and whether they are complete.
    """
    n, words = prices.inside.shape
    found = _empty_halves(capacity, n, words)
    kept, S = np.empty((1, words), np.uint64), np.empty(words, np.uint64)
    least = cheapest(ends)
    slots, count, complete = _start(found, empty_slots(1 << 16), side, prices, interest, rest)
    current = 0
    while complete and current < count:
        slots, count, complete = _extend(
            found, slots, count, current, side, prices, memory, interest, rest, ends, least,
            kept, S,
        )  # fmt: skip
        complete = complete and stop[0] == 0
        current += 1
    return _in_use(found, count), complete
