"""Joined halves: flights made of half flights and hashed on their sets.

A flight is made at the leg during which half of t_max goes by, or of one half alone, as labels are
in :mod:`windopt.solving.exact.joins`; of those over one set of turbines the fastest is kept.
Flights that the prices of an earlier list leave out are not.

Every other turbine is marked, and the parity of a flight is that of the number of these it visits,
the sum of its halves' parities. Flights of either parity are made apart, of pairs of halves that
are tried for this parity only, and no set of turbines has both.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, bit
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.half_flights import Halves
from windopt.solving.exact.hashing import empty_slots, row_hash, same_rows
from windopt.solving.exact.labels import Ints, Prices, Words, price_of
from windopt.solving.exact.network import SLACK, Floats, Side
from windopt.solving.exact.rank_one_rows import BITS, Ints64
from windopt.solving.exact.screening import (
    ListPrices,
    Looks,
    count_weights,
    earned,
    exceeds,
    turbines_of,
)

Parities = NDArray[np.uint8]

MARKED = np.uint64(0x5555555555555555)
"""The marked turbines of each word."""


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


def parities(halves: Halves) -> Parities:
    """Return 1 for each half that visits an odd number of marked turbines, 0 for the others."""
    found: Parities = np.bitwise_count(halves.set & MARKED).sum(axis=1, dtype=np.uint8) & 1
    return found


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


@inlined
def _record(
    sets: Sets, slots: Ints, count: int, cost: float, d: int, ahead: int, behind: int, apart: bool
) -> tuple[Ints, int, bool]:
    """Keep the flight whose turbines are in row ``count`` if it is the fastest of its set.

    Returns the hash table, the number of flights in use, and whether there was room.
    """
    sets.station[count] = d
    slot = _slot(slots, sets, count, apart)
    row = slots[slot]
    if row >= 0 and sets.cost[row] <= cost:
        return slots, count, True
    if row < 0:
        if count == len(sets.cost) - 1:
            return slots, count, False
        row = slots[slot] = count
        count += 1
        if 2 * count > len(slots):
            slots = empty_slots(4 * len(slots))
            for old in range(count):
                slots[_slot(slots, sets, old, apart)] = old
    sets.cost[row], sets.station[row], sets.ahead[row], sets.behind[row] = cost, d, ahead, behind
    return slots, count, True


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


class Terms(NamedTuple):
    """What flights of one station keep to.

    Attributes
    ----------
    d
        The station.
    t_max, half
        Longest flight, and when its halves meet.
    limit, screened
        Cost that none exceeds, by the prices of labels and by those of a list.
    most
        Flights of one parity to make at most, those that are left out among them.
    width
        Of a time bucket of halves.
    apart
        Whether to keep a flight over each set for each station.
    """

    d: int
    t_max: float
    half: float
    limit: float
    screened: float
    most: int
    width: float
    apart: bool


@inlined
def _add_behind(
    backward: Halves, order: NDArray[np.int64], own: Parities, looks: Looks, parity: int,
    side: Side, terms: Terms, sets: Sets, slots: Ints, count: int,
) -> tuple[Ints, int, bool]:  # fmt: skip
    """Add the backward halves that are flights by themselves: half goes by on their first leg."""
    for b in range(len(backward.T)):
        if own[b] != parity:
            continue
        j = backward.node[b]
        whole = side.first[j] + backward.T[b]
        in_time = side.first[j] > terms.half and whole <= terms.t_max + SLACK
        if looks.alone[b] + side.first[j] > terms.screened:
            continue
        if in_time and backward.C[b] + side.first_cost[j] <= terms.limit:
            _union(sets, count, backward.set, b, backward.set, -1)
            slots, count, fitted = _record(
                sets, slots, count, whole, terms.d, -1, order[b], terms.apart
            )
            if not fitted:
                return slots, count, False
    return slots, count, True


@inlined
def _add_ahead(
    forward: Halves, f: int, looks: Looks, side: Side, terms: Terms, sets: Sets, slots: Ints,
    count: int,
) -> tuple[Ints, int, bool]:  # fmt: skip
    """Add a forward half as a flight by itself."""
    i = forward.node[f]
    whole = forward.T[f] + side.last[i]
    if looks.alone[f] + side.last[i] > terms.screened:
        return slots, count, True
    if forward.C[f] + side.last_cost[i] > terms.limit or whole > terms.t_max + SLACK:
        return slots, count, True
    _union(sets, count, forward.set, f, forward.set, -1)
    return _record(sets, slots, count, whole, terms.d, f, -1, terms.apart)


@inlined
def _left_out(
    forward: Looks, f: int, leg: float, backward: Looks, b: int, turbines: Words,
    prices: ListPrices, counter: Words, inside: Ints64, terms: Terms, sets: Sets, count: int,
) -> bool:  # fmt: skip
    """Tell whether the prices of a list leave out the flight whose turbines are in row ``count``.

    Parameters
    ----------
    counter
        The counters of the forward half.
    turbines
        The sets of backward halves.
    inside
        Room for the turbines of one.
    """
    out = forward.alone[f] + leg + backward.alone[b] > terms.screened
    if not out and counter.shape[1] > 0:
        size = turbines_of(turbines, b, inside)
        cost = forward.time[f] + leg + backward.time[b] - earned(prices, sets.set, count)
        out = exceeds(prices, counter, inside, size, cost, terms.screened)
    return out


@inlined
def _add_joined(
    forward: Halves, f: int, ahead: Looks, backward: Halves, behind: Looks, parity: int,
    order: NDArray[np.int64], groups: NDArray[np.int64], side: Side, prices: Prices,
    list_prices: ListPrices, counter: Words, inside: Ints64, terms: Terms, sets: Sets, slots: Ints,
    count: int, made: int,
) -> tuple[Ints, int, int, bool]:  # fmt: skip
    """Add a forward half with each backward one of a parity that goes with it."""
    n = len(side.first)
    buckets = (len(groups) - 1) // (2 * n)
    i = forward.node[f]
    for e in range(side.degree[i]):
        j = side.heads[i, e]
        t, c = forward.T[f] + side.legs[i, j], forward.C[f] + side.legs_cost[i, j]
        left = terms.t_max - t + SLACK
        visited = forward.set[f, j >> 6] & bit(j) != NONE
        if t <= terms.half or left < 0.0 or visited:
            continue
        first = (parity * n + j) * buckets
        for group in range(first, first + min(buckets, int(left / terms.width) + 1)):
            for b in range(groups[group], groups[group + 1]):
                cost = c + backward.C[b]
                if cost > terms.limit:
                    break
                if backward.T[b] > left or not _disjoint(forward.set, f, backward.set, b):
                    continue
                for word in range(forward.S.shape[1]):
                    both = forward.S[f, word] & backward.S[b, word] & prices.memory[i, j, word]
                    cost += price_of(both, word, prices.penalty)
                if cost > terms.limit:
                    continue
                made += 1
                _union(sets, count, forward.set, f, backward.set, b)
                if _left_out(
                    ahead, f, side.legs[i, j], behind, b, backward.set, list_prices, counter,
                    inside, terms, sets, count,
                ):  # fmt: skip
                    continue
                whole = t + backward.T[b]
                slots, count, fitted = _record(
                    sets, slots, count, whole, terms.d, f, order[b], terms.apart
                )
                if not fitted:
                    return slots, count, made, False
    return slots, count, made, made <= terms.most


@compiled
def join_halves(
    forward: Halves,
    backward: Halves,
    ahead: Looks,
    behind: Looks,
    odd_ahead: Parities,
    odd_behind: Parities,
    parity: int,
    order: NDArray[np.int64],
    groups: NDArray[np.int64],
    side: Side,
    prices: Prices,
    list_prices: ListPrices,
    terms: Terms,
    sets: Sets,
    slots: Ints,
    count: int,
    made: int,
    stop: NDArray[np.uint8],
) -> tuple[Ints, int, int, bool]:
    """Add the flights of one station and one parity to ``sets``.

    Parameters
    ----------
    ahead, behind
        What each half costs by the prices of a list, forward and backward.
    odd_ahead, odd_behind
        The parity of each half.
    order, groups
        Backward halves, cheapest first within each group: those of bucket b of turbine j are
        ``order[groups[j * buckets + b] : groups[j * buckets + b + 1]]`` where they are even, and
        ``n * buckets`` groups further on where they are odd.
    slots
        Hash table of the flights in ``sets``, a power of two long: rows, or -1.
    made
        Flights of this parity made so far, those that were left out among them.

    Returns
    -------
    The hash table, the number of flights in ``sets``, how many were made, and whether that were
    all.
    """
    counter = np.empty((BITS, list_prices.odd.shape[1]), np.uint64)
    inside = np.empty(len(list_prices.pi), np.int64)
    slots, count, fitted = _add_behind(
        backward, order, odd_behind, behind, parity, side, terms, sets, slots, count
    )
    for f in range(len(forward.T)):
        if not fitted or stop[0] != 0:
            return slots, count, made, False
        if odd_ahead[f] == parity:
            slots, count, fitted = _add_ahead(forward, f, ahead, side, terms, sets, slots, count)
        if fitted:
            if counter.shape[1] > 0:
                size = turbines_of(forward.set, f, inside)
                count_weights(list_prices, inside, size, counter)
            slots, count, made, fitted = _add_joined(
                forward, f, ahead, backward, behind, parity ^ odd_ahead[f], order, groups, side,
                prices, list_prices, counter, inside, terms, sets, slots, count, made,
            )  # fmt: skip
    return slots, count, made, fitted
