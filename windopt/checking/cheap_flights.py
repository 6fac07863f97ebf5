"""Cheap flights: all that earn almost what they take, at given prices.

They are found by flying on from turbine to turbine, every way that some tail may still make cheap.
Of two ways to the same turbine over the same ones the faster is followed, so that each set of
turbines is looked at once for each turbine that may be its last.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.checking.compiled import compiled
from windopt.checking.flight_list import FlightList, fastest, fastest_of_each_set
from windopt.checking.tails import (
    Market,
    Tails,
    TooMany,
    Words,
    has,
    put,
    singles,
    tails_of_interest,
)
from windopt.checking.times import Floats, Times

MOST_BEGUN, MOST_LISTED = 10_000_000, 5_000_000
"""Flights on their way to as many turbines, and flights to list, at most for one station."""


class Begun(NamedTuple):
    """Flights on their way.

    Attributes
    ----------
    visited, at
        The turbines visited, as bits, shape ``(m, words)``, and the last of them.
    time, cost
        Time [s], and time less prices [s].
    """

    visited: Words
    at: NDArray[np.int32]
    time: Floats
    cost: Floats

    def rows(self, chosen: NDArray[np.intp] | slice) -> "Begun":
        """Return some of them."""
        return Begun(self.visited[chosen], self.at[chosen], self.time[chosen], self.cost[chosen])


@compiled
def _may_end(visited: Words, row: int, tails: Tails, j: int, time: float, cost: float) -> bool:
    """Tell whether a tail from j within ``time`` and ``cost`` remembers no turbine visited."""
    for tail in range(tails.first[j], tails.first[j + 1]):
        if tails.cost[tail] > cost:
            return False
        if tails.time[tail] <= time:
            common = np.uint64(0)
            for word in range(visited.shape[1]):
                common |= visited[row, word] & tails.visited[tail, word]
            if common == 0:
                return True
    return False


@compiled
def _fly_on(begun: Begun, market: Market, tails: Tails, further: Begun) -> int:
    """Fly on to each turbine from which a tail may lead home; return how many flights do."""
    count = 0
    for row in range(len(begun.at)):
        i = begun.at[row]
        for j in range(len(market.prices)):
            time = begun.time[row] + market.times.between[i, j]
            left = market.times.longest - time
            if not left >= 0.0 or has(begun.visited, row, j):
                continue
            cost = begun.cost[row] + market.times.between[i, j] - market.prices[j]
            if not _may_end(begun.visited, row, tails, j, left, market.limit - cost):
                continue
            if count == len(further.at):
                return -1
            further.visited[count] = begun.visited[row]
            put(further.visited, count, j)
            further.at[count], further.time[count], further.cost[count] = j, time, cost
            count += 1
    return count


def _cheap_flights_of(market: Market) -> tuple[Floats, Words]:
    """Return time and turbines of the flights of one station within the limit."""
    tails, n = tails_of_interest(market), len(market.prices)
    times, every = market.times, np.arange(n, dtype=np.int32)
    begun = Begun(singles(n), every, times.out, times.out - market.prices)
    begun = begun.rows(np.flatnonzero(times.out <= times.longest))
    room = Begun(
        np.empty((MOST_BEGUN, begun.visited.shape[1]), np.uint64), np.empty(MOST_BEGUN, np.int32),
        np.empty(MOST_BEGUN), np.empty(MOST_BEGUN),
    )  # fmt: skip
    found, listed = [(np.zeros(0), begun.visited[:0])], 0
    while len(begun.at):
        home = times.back[begun.at]
        fits = begun.time + home <= times.longest
        ends = np.flatnonzero(fits & (begun.cost + home <= market.limit))
        found.append((begun.time[ends] + home[ends], begun.visited[ends]))
        count, listed = _fly_on(begun, market, tails, room), listed + len(ends)
        if count < 0 or listed > MOST_LISTED:
            raise TooMany
        begun = room.rows(slice(0, count))
        begun = begun.rows(fastest(begun.time, begun.at, begun.visited))
    time, visited = zip(*found, strict=True)
    return np.concatenate(time), np.concatenate(visited)


def cheap_flights(
    times: Sequence[Times],
    prices: Floats,
    neighbours: Sequence[Sequence[int]],
    limits: Sequence[float],
    *,
    apart: bool = False,
) -> FlightList:
    """Return all flights whose time exceeds the prices of their turbines by little.

    Parameters
    ----------
    times
        Of each station's legs.
    prices
        Of a visit to each turbine [s], shape ``(n,)``.
    neighbours
        Turbines near each turbine; better ones make this quicker.
    limits
        By how much it may [s], for each station.
    apart
        Whether it matters which station a flight is from.

    Returns
    -------
    The fastest over each set of turbines, or the fastest of each station.

    Raises
    ------
    TooMany
        If more partial flights would have to be looked at than this machine should.
    """
    near = singles(len(prices))
    for i, others in enumerate(neighbours):
        for j in others:
            put(near, i, j)
    each = zip(times, limits, strict=True)
    flights = [_cheap_flights_of(Market(legs, prices, near, limit)) for legs, limit in each]
    time = np.concatenate([time for time, _ in flights])
    visited = np.concatenate([visited for _, visited in flights])
    station = np.repeat(np.arange(len(times)), [len(time) for time, _ in flights])
    return fastest_of_each_set(FlightList(time, station, visited, len(prices)), apart=apart)
