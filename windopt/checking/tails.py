"""Tails: what flying on and home from a turbine costs at least, at given prices.

A tail is the part of a flight from one of its turbines to the station. To keep them few a tail
forgets the turbines far from where it has been since: it remembers one only as long as all that it
visits have that turbine for a neighbour. So it may visit a turbine twice, which makes the least
cost a bound whatever the neighbours are. Tails grow from the station backwards, a turbine at a
time. Of two at a turbine one is useless if the other is no later, no dearer and remembers no more.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.checking.compiled import compiled
from windopt.checking.times import Floats, Times

Words = NDArray[np.uint64]

MOST = 5_000_000
"""Tails to make at most, for one station."""


class TooMany(Exception):  # noqa: N818  (a verdict, not a mistake)
    """There are more partial flights than the checker is ready to look at."""


class Market(NamedTuple):
    """What a flight of one station earns, and how dear it may be.

    Attributes
    ----------
    prices
        Of a visit to each turbine [s], shape ``(n,)``.
    near
        The neighbours of each turbine as bits, shape ``(n, words)``.
    limit
        Time less prices [s] that a flight of interest does not exceed.
    """

    times: Times
    prices: Floats
    near: Words
    limit: float


class Tails(NamedTuple):
    """Tails, those of turbine i in the rows ``first[i]`` to ``first[i + 1]``, cheapest first.

    Attributes
    ----------
    time, cost
        Of each tail [s]; the cost is the time less the prices of the turbines after i.
    visited
        What it remembers, i included, as bits, shape ``(m, words)``.
    """

    time: Floats
    cost: Floats
    visited: Words
    first: NDArray[np.int64]


class Stairs(NamedTuple):
    """The least cost of a tail from turbine i within a time, in the rows of i as in Tails."""

    time: Floats
    cost: Floats
    first: NDArray[np.int64]


def stairs(tails: Tails) -> Stairs:
    """Return the least cost of ``tails`` by time."""
    turbine = np.repeat(np.arange(len(tails.first) - 1), np.diff(tails.first))
    order = np.lexsort((tails.cost, tails.time, turbine))
    time, cost = tails.time[order], tails.cost[order]
    for i in range(len(tails.first) - 1):
        mine = slice(tails.first[i], tails.first[i + 1])
        cost[mine] = np.minimum.accumulate(cost[mine])
    return Stairs(time, cost, tails.first)


@compiled
def least_cost(rest: Stairs, i: int, time: float) -> float:
    """Return the least cost of a tail from turbine i that takes at most ``time``."""
    begin, end = rest.first[i], rest.first[i + 1]
    low = begin
    while low < end:
        middle = (low + end) // 2
        if rest.time[middle] <= time:
            low = middle + 1
        else:
            end = middle
    return rest.cost[low - 1] if low > begin else inf


class Growing(NamedTuple):
    """Tails in the order in which they are found; those of one turbine are a linked list.

    Attributes
    ----------
    at
        Where they begin.
    earlier, latest
        The tail found before each at the same turbine, and the latest at each turbine, or -1.
    """

    time: Floats
    cost: Floats
    visited: Words
    at: NDArray[np.int32]
    earlier: NDArray[np.int32]
    latest: NDArray[np.int32]


@compiled
def has(sets: Words, row: int, i: int) -> bool:
    """Tell whether turbine i is in a set."""
    return bool(sets[row, i >> 6] >> np.uint64(i & 63) & np.uint64(1))


@compiled
def put(sets: Words, row: int, i: int) -> None:
    """Add turbine i to a set."""
    sets[row, i >> 6] |= np.uint64(1) << np.uint64(i & 63)


@compiled
def _contains(sets: Words, larger: int, smaller: int) -> bool:
    missing = np.uint64(0)
    for word in range(sets.shape[1]):
        missing |= sets[smaller, word] & ~sets[larger, word]
    return bool(missing == 0)


@compiled
def _useful(tails: Growing, new: int, h: int) -> bool:
    """Tell whether no tail at h makes ``new`` useless, and drop those that it makes useless."""
    T, C, V = tails.time, tails.cost, tails.visited
    after, other = -1, tails.latest[h]
    while other >= 0:
        if T[other] <= T[new] and C[other] <= C[new] and _contains(V, new, other):
            return False
        earlier = tails.earlier[other]
        if T[new] <= T[other] and C[new] <= C[other] and _contains(V, other, new):
            C[other] = inf
            if after < 0:
                tails.latest[h] = earlier
            else:
                tails.earlier[after] = earlier
        else:
            after = other
        other = earlier
    return True


@compiled
def _lengthen(
    tails: Growing, start: int, end: int, market: Market, horizon: float, rest: Stairs, half: float
) -> int:
    """Put each turbine before each of the tails ``start`` to ``end``.

    Parameters
    ----------
    horizon
        Longest tail to make [s].
    rest, half
        A tail longer than ``half`` is made only if some way to where it begins, of which ``rest``
        knows the cost, makes it part of a flight within the limit.

    Returns
    -------
    The end of the new tails; -1 where there is no room.
    """
    count = end
    for tail in range(start, end):
        i = tails.at[tail]
        if tails.cost[tail] == inf:
            continue
        for h in range(len(market.prices)):
            time = tails.time[tail] + market.times.between[h, i]
            if not time <= horizon or has(tails.visited, tail, h):
                continue
            cost = tails.cost[tail] + market.times.between[h, i] - market.prices[i]
            if time > half:
                before = least_cost(rest, h, market.times.longest - time)
                if cost - market.prices[h] + before > market.limit:
                    continue
            if count == len(tails.time):
                return -1
            for word in range(tails.visited.shape[1]):
                tails.visited[count, word] = tails.visited[tail, word] & market.near[h, word]
            put(tails.visited, count, h)
            tails.time[count], tails.cost[count], tails.at[count] = time, cost, h
            if _useful(tails, count, h):
                tails.earlier[count], tails.latest[h] = tails.latest[h], count
                count += 1
    return count


def _all_tails(market: Market, horizon: float, rest: Stairs, half: float) -> Tails:
    """Return the useful tails no longer than ``horizon``.

    Raises
    ------
    TooMany
        If there are more than :data:`MOST`.
    """
    n, words = market.near.shape
    back = market.times.back
    tails = Growing(
        np.empty(MOST), np.empty(MOST), np.empty((MOST, words), np.uint64),
        np.empty(MOST, np.int32), np.empty(MOST, np.int32), np.full(n, -1, np.int32),
    )  # fmt: skip
    last = np.flatnonzero(back <= horizon)
    end = len(last)
    tails.time[:end] = tails.cost[:end] = back[last]
    tails.visited[:end], tails.at[:end], tails.earlier[:end] = singles(n)[last], last, -1
    tails.latest[last] = np.arange(end)
    start = 0
    # A tail may be useless beside one of more turbines than there are, so these grow on as well.
    while start < end:
        start, end = end, _lengthen(tails, start, end, market, horizon, rest, half)
        if end < 0:
            raise TooMany
    kept = np.flatnonzero(tails.cost[:end] < inf)
    order = kept[np.lexsort((tails.cost[kept], tails.at[kept]))]
    first = np.searchsorted(tails.at[order], np.arange(n + 1))
    return Tails(tails.time[order], tails.cost[order], tails.visited[order], first)


def singles(n: int) -> Words:
    """Return each of n turbines as a set of its own, shape ``(n, words)``."""
    sets = np.zeros((n, -(-n // 64)), np.uint64)
    each = np.arange(n)
    sets[each, each >> 6] = np.uint64(1) << (each & 63).astype(np.uint64)
    return sets


def tails_of_interest(market: Market) -> Tails:
    """Return the tails that some flight within the limit may end with, as far as they remember.

    Heads, which are tails of the flights read from their end, are made up to half of the longest
    flight; they tell which tails beyond the other half are worth making.
    """
    half, n = market.times.longest / 2, len(market.prices)
    nothing = Stairs(np.empty(0), np.empty(0), np.zeros(n + 1, np.int64))
    backwards = market._replace(times=market.times.reversed())
    heads = _all_tails(backwards, half, nothing, inf)
    return _all_tails(market, market.times.longest, stairs(heads), half)
