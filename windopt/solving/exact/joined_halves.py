"""Joined halves: flights made of half flights and hashed on their sets.

A flight is made at the leg during which half of t_max goes by, or of one half alone, as labels are
in :mod:`windopt.solving.exact.joins`; of those over one set of turbines the fastest is kept.
Flights that the prices of an earlier list leave out are not.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, bit
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.half_flights import Halves
from windopt.solving.exact.kept_flights import Sets, disjoint, record, unite
from windopt.solving.exact.labels import Ints, Prices, Words, price_of
from windopt.solving.exact.list_prices import (
    ListPrices,
    Looks,
    count_weights,
    earned,
    exceeds,
    turbines_of,
)
from windopt.solving.exact.network import SLACK, Side
from windopt.solving.exact.parities import Parities
from windopt.solving.exact.rank_one_rows import BITS, Ints64


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
        Pairs of halves to join at most, of one parity.
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
            unite(sets, count, backward.set, b, backward.set, -1)
            slots, count, fitted = record(
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
    unite(sets, count, forward.set, f, forward.set, -1)
    return record(sets, slots, count, whole, terms.d, f, -1, terms.apart)


@inlined
def _left_out(
    ahead: Looks, f: int, leg: float, behind: Looks, b: int, turbines: Words,
    list_prices: ListPrices, counter: Words, inside: Ints64, terms: Terms, sets: Sets, count: int,
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
    out = bool(ahead.alone[f] + leg + behind.alone[b] > terms.screened)
    if not out and counter.shape[1] > 0:  # without rows, sets that both halves enter count twice
        size = turbines_of(turbines, b, inside)
        cost = ahead.time[f] + leg + behind.time[b] - earned(list_prices, sets.set, count)
        out = exceeds(list_prices, counter, inside, size, cost, terms.screened)
    return out


@inlined
def _add_joined(
    forward: Halves, f: int, ahead: Looks, backward: Halves, behind: Looks, parity: int,
    order: NDArray[np.int64], groups: NDArray[np.int64], side: Side, prices: Prices,
    list_prices: ListPrices, counter: Words, inside: Ints64, terms: Terms, sets: Sets, slots: Ints,
    count: int, joined: int,
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
                if backward.T[b] > left or not disjoint(forward.set, f, backward.set, b):
                    continue
                for word in range(forward.S.shape[1]):
                    both = forward.S[f, word] & backward.S[b, word] & prices.memory[i, j, word]
                    cost += price_of(both, word, prices.penalty)
                if cost > terms.limit:
                    continue
                joined += 1
                unite(sets, count, forward.set, f, backward.set, b)
                if _left_out(
                    ahead, f, side.legs[i, j], behind, b, backward.set, list_prices, counter,
                    inside, terms, sets, count,
                ):  # fmt: skip
                    continue
                whole = t + backward.T[b]
                slots, count, fitted = record(
                    sets, slots, count, whole, terms.d, f, order[b], terms.apart
                )
                if not fitted:
                    return slots, count, joined, False
    return slots, count, joined, joined <= terms.most


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
    joined: int,
    stop: NDArray[np.uint8],
) -> tuple[Ints, int, int, bool]:
    """Add the flights of one station and one parity to ``sets``.

    Parameters
    ----------
    ahead, behind
        What each half costs by the prices of a list, forward and backward.
    odd_ahead, odd_behind
        The parity of each half.
    backward, order, groups
        The backward halves are sorted, cheapest first within each group; ``order`` tells which
        each was before. Those of bucket b of turbine j begin at row ``groups[j * buckets + b]``
        where they are even, and ``n * buckets`` groups further on where they are odd.
    slots
        Hash table of the flights in ``sets``, a power of two long: rows, or -1.
    joined
        Pairs of halves joined so far, of this parity.

    Returns
    -------
    The hash table, the number of flights in ``sets``, how many pairs were joined, and whether
    these are all.
    """
    counter = np.empty((BITS, list_prices.ones.shape[1]), np.uint64)
    inside = np.empty(len(list_prices.pi), np.int64)
    slots, count, fitted = _add_behind(
        backward, order, odd_behind, behind, parity, side, terms, sets, slots, count
    )
    for f in range(len(forward.T)):
        if not fitted or stop[0] != 0:
            return slots, count, joined, False
        if odd_ahead[f] == parity:
            slots, count, fitted = _add_ahead(forward, f, ahead, side, terms, sets, slots, count)
        if fitted:
            if counter.shape[1] > 0:
                size = turbines_of(forward.set, f, inside)
                count_weights(list_prices, inside, size, counter)
            slots, count, joined, fitted = _add_joined(
                forward, f, ahead, backward, behind, parity ^ odd_ahead[f], order, groups, side,
                prices, list_prices, counter, inside, terms, sets, slots, count, joined,
            )  # fmt: skip
    return slots, count, joined, fitted
