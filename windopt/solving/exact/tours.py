"""Tours: a plan as linked lists, for turbines to be put in and taken out in no time."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np

from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.network import Floats, Network
from windopt.solving.exact.search import Flight, Search

FAR = 1e6
"""Time of a leg that cannot be flown: finite, so that it can be taken back."""
NOWHERE = -1


class Legs(NamedTuple):
    """What flights cost and may be.

    Attributes
    ----------
    out, between, back
        Times of all stations, shapes ``(k, n)``, ``(k, n, n)`` and ``(k, n)``.
    t_max, most
        Longest flight and most flights of each station, shape ``(k,)``.
    prize
        Cost of leaving each turbine out, shape ``(n,)``.
    """

    out: Floats
    between: Floats
    back: Floats
    t_max: Floats
    most: Floats
    prize: Floats

    @classmethod
    def of(cls, search: Search) -> Self:
        """Return those of a search."""
        networks = search.networks
        between = [np.where(np.isfinite(net.legs), net.legs, FAR) for net in networks]
        return cls(
            np.array([network.out for network in networks]),
            np.array(between),
            np.array([network.back for network in networks]),
            np.array([network.t_max for network in networks]),
            # Contiguous for any number of stations, or numba would compile a second version.
            np.ascontiguousarray(search.counts[:-1, 1]),
            search.prize,
        )


class Tours(NamedTuple):
    """Flights as linked lists; a flight without turbines is free to be used.

    Attributes
    ----------
    after, before, flight
        Of each turbine: its neighbours on its flight, and the flight, if it is on one.
    first, last, station, size, time
        Of each flight.
    """

    after: Ints
    before: Ints
    flight: Ints
    first: Ints
    last: Ints
    station: Ints
    size: Ints
    time: Floats


@compiled
def copy(source: Tours, target: Tours) -> None:
    target.after[:] = source.after
    target.before[:] = source.before
    target.flight[:] = source.flight
    target.first[:] = source.first
    target.last[:] = source.last
    target.station[:] = source.station
    target.size[:] = source.size
    target.time[:] = source.time


@compiled
def detour(legs: Legs, d: int, a: int, i: int, b: int) -> float:
    """Return the time that visiting i between a and b adds; the station is ``NOWHERE``."""
    arrive = legs.out[d, i] if a < 0 else legs.between[d, a, i]
    leave = legs.back[d, i] if b < 0 else legs.between[d, i, b]
    direct = 0.0
    if a >= 0 and b >= 0:
        direct = legs.between[d, a, b]
    elif b >= 0:
        direct = legs.out[d, b]
    elif a >= 0:
        direct = legs.back[d, a]
    return float(arrive + leave - direct)


@compiled
def insert(tours: Tours, legs: Legs, i: int, r: int, a: int) -> None:
    """Put turbine i into flight r behind a."""
    b = tours.first[r] if a < 0 else tours.after[a]
    tours.time[r] += detour(legs, tours.station[r], a, i, b)
    tours.flight[i], tours.before[i], tours.after[i] = r, a, b
    tours.size[r] += 1
    if a < 0:
        tours.first[r] = i
    else:
        tours.after[a] = i
    if b < 0:
        tours.last[r] = i
    else:
        tours.before[b] = i


@compiled
def remove(tours: Tours, legs: Legs, i: int) -> None:
    """Take turbine i out of its flight."""
    r, a, b = tours.flight[i], tours.before[i], tours.after[i]
    tours.time[r] -= detour(legs, tours.station[r], a, i, b)
    tours.flight[i] = NOWHERE
    tours.size[r] -= 1
    if a < 0:
        tours.first[r] = b
    else:
        tours.after[a] = b
    if b < 0:
        tours.last[r] = a
    else:
        tours.before[b] = a
    if tours.size[r] == 0:
        tours.time[r] = 0.0


@compiled
def clone(tours: Tours) -> Tours:
    return Tours(
        tours.after.copy(),
        tours.before.copy(),
        tours.flight.copy(),
        tours.first.copy(),
        tours.last.copy(),
        tours.station.copy(),
        tours.size.copy(),
        tours.time.copy(),
    )


@compiled
def cost_of(tours: Tours, legs: Legs) -> float:
    """Return the time of all flights and the prizes they leave behind."""
    cost = tours.time.sum()
    for i in range(len(tours.flight)):
        if tours.flight[i] < 0:
            cost += legs.prize[i]
    return float(cost)


def tours_of(networks: list[Network], flights: Sequence[Flight]) -> Tours:
    """Write a plan as linked lists."""
    n = len(networks[0].out)
    after, before, flight, first, last, station = np.full((6, n), NOWHERE, np.int32)
    size = np.zeros(n, np.int32)
    tours = Tours(after, before, flight, first, last, station, size, np.zeros(n))
    for r, (d, path) in enumerate(flights):
        tours.first[r], tours.last[r] = path[0], path[-1]
        tours.station[r], tours.size[r] = d, len(path)
        tours.time[r] = networks[d].duration(path)
        tours.flight[list(path)] = r
        for i, j in pairwise(path):
            tours.after[i], tours.before[j] = j, i
    return tours


def flights_of(tours: Tours) -> list[Flight]:
    """Read a plan from linked lists."""
    flights = []
    for r in np.flatnonzero(tours.size):
        path = [int(tours.first[r])]
        while tours.after[path[-1]] >= 0:
            path.append(int(tours.after[path[-1]]))
        flights.append((int(tours.station[r]), tuple(path)))
    return flights
