"""Half flights: all elementary ones that may be part of a flight of interest.

They are hashed on their last turbine and their set, keeping the fastest, and dropped when no label
from the other end completes them below the limit.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, bit
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.hashing import empty_slots, row_hash, same_rows
from windopt.solving.exact.joins import cheapest, partner
from windopt.solving.exact.labels import EPS, Ints, Labels, Memory, Prices, Words, price_of
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
    slots = empty_slots(1 << 16)
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
                slots = empty_slots(4 * len(slots))
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
