"""A good plan to begin with: ruin and recreate under simulated annealing.

Strings of neighbouring flights are torn out and their turbines put back one by one where they
cost least, now and then not quite there. The method is slack induction by string removals [1],
with several stations and a limit on the time of a flight in place of one on its load.

* [1] Christiaens & Vanden Berghe (2020), *Transportation Science* 54, 417-433.
"""

# ruff: noqa: NPY002  (compiled code has a generator of its own, which only these names reach)

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.network import SLACK, Floats, Network
from windopt.solving.exact.search import Flight, Search

REMOVED = 10.0
"""Turbines to tear out in one ruin, on average ([1], section 6.2)."""
STRING = 10
"""Longest string to tear out of one flight ([1], section 6.2)."""
BLINK = 0.01
"""Share of places that a recreation overlooks ([1], section 6.2)."""
ITERATIONS = 300
"""Ruins and recreations for each turbine."""
RUNS = 2
"""Runs side by side, each with random numbers of its own."""
CLOSE = 40
"""Nearest turbines beside which a turbine is put back; farther ones seldom cost least."""
HOT, COLD = 5.0, 0.03
"""First and last temperature, as fractions of the shortest leg of a typical turbine."""
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
def _copy(source: Tours, target: Tours) -> None:
    target.after[:] = source.after
    target.before[:] = source.before
    target.flight[:] = source.flight
    target.first[:] = source.first
    target.last[:] = source.last
    target.station[:] = source.station
    target.size[:] = source.size
    target.time[:] = source.time


@compiled
def _detour(legs: Legs, d: int, a: int, i: int, b: int) -> float:
    """Return the time that visiting i between a and b adds; the station is :data:`NOWHERE`."""
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
def _insert(tours: Tours, legs: Legs, i: int, r: int, a: int) -> None:
    """Put turbine i into flight r behind a."""
    b = tours.first[r] if a < 0 else tours.after[a]
    tours.time[r] += _detour(legs, tours.station[r], a, i, b)
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
def _remove(tours: Tours, legs: Legs, i: int) -> None:
    """Take turbine i out of its flight."""
    r, a, b = tours.flight[i], tours.before[i], tours.after[i]
    tours.time[r] -= _detour(legs, tours.station[r], a, i, b)
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
def _ruin(tours: Tours, legs: Legs, near: Ints, torn: Ints, mark: int) -> None:
    """Tear strings out of flights near a random turbine."""
    n = len(near)
    flying = max(1, (tours.size > 0).sum())
    string = max(1.0, min(float(STRING), n / flying))
    strings = int(np.random.random() * (4.0 * REMOVED / (1.0 + string) - 1.0) + 1.0)
    for i in near[np.random.randint(n)]:
        r = tours.flight[i]
        if strings == 0:
            break
        if r < 0 or torn[r] == mark:
            continue
        torn[r] = mark
        strings -= 1
        length = int(np.random.random() * min(string, float(tours.size[r])) + 1.0)
        length = min(length, tours.size[r])
        j = i  # the string holds i: step back a random number of turbines, then tear forward
        for _ in range(np.random.randint(length)):
            if tours.before[j] < 0:
                break
            j = tours.before[j]
        for _ in range(length):
            if j < 0:
                break
            following = tours.after[j]
            _remove(tours, legs, j)
            j = following


@compiled
def _recreate(tours: Tours, legs: Legs, near: Ints, gone: Ints) -> bool:
    """Put each turbine of ``gone`` where it costs least, unless its prize is less.

    Tells whether all that must be inspected found a place.
    """
    sent = np.zeros(len(legs.most))
    for r in range(len(tours.size)):
        if tours.size[r] > 0:
            sent[tours.station[r]] += 1.0
    for i in gone:
        best, flight, behind, station = np.inf, NOWHERE, NOWHERE, NOWHERE
        for j in near[i, 1:]:
            r = tours.flight[j]
            if r < 0 or np.random.random() < BLINK:
                continue
            d = tours.station[r]
            room = min(best, legs.t_max[d] - tours.time[r] + SLACK)
            ahead = _detour(legs, d, tours.before[j], i, j)
            if ahead < room:
                best, room, flight, behind = ahead, ahead, r, tours.before[j]
            astern = _detour(legs, d, j, i, tours.after[j])
            if astern < room:
                best, flight, behind = astern, r, j
        for d in range(len(legs.t_max)):
            alone = legs.out[d, i] + legs.back[d, i]
            if alone < best and alone <= legs.t_max[d] + SLACK and sent[d] < legs.most[d]:
                best, station, flight, behind = alone, d, NOWHERE, NOWHERE
        if best >= legs.prize[i]:
            if legs.prize[i] == np.inf:
                return False
            continue
        if flight < 0:
            flight = 0
            while tours.size[flight] > 0:
                flight += 1
            tours.station[flight] = station
            sent[station] += 1.0
            tours.first[flight] = tours.last[flight] = NOWHERE
        _insert(tours, legs, i, flight, behind)
    return True


@compiled
def _cost(tours: Tours, legs: Legs) -> float:
    """Return the time of all flights and the prizes they leave behind."""
    cost = tours.time.sum()
    for i in range(len(tours.flight)):
        if tours.flight[i] < 0:
            cost += legs.prize[i]
    return float(cost)


@compiled
def _shuffle(gone: Ints, remoteness: Floats) -> None:
    """Order turbines at random, or the remote ones first, or last."""
    draw = np.random.random()
    np.random.shuffle(gone)
    if draw < 0.4:
        gone[:] = gone[np.argsort(-remoteness[gone])]
    elif draw < 0.5:
        gone[:] = gone[np.argsort(remoteness[gone])]


@compiled
def _anneal(
    tours: Tours,
    legs: Legs,
    near: Ints,
    remoteness: Floats,
    temperatures: Floats,
    seed: int,
    stop: NDArray[np.uint8],
) -> None:
    """Improve ``tours`` in place, an iteration for each of ``temperatures``."""
    np.random.seed(seed)
    n = len(near)
    now, trial = _clone(tours), _clone(tours)
    best = cost = _cost(tours, legs)
    torn = np.full(n, -1, np.int32)
    for iteration in range(len(temperatures)):
        if stop[0] != 0:
            return
        _ruin(trial, legs, near, torn, iteration)
        gone = np.flatnonzero(trial.flight < 0).astype(np.int32)
        _shuffle(gone, remoteness)
        placed = _recreate(trial, legs, near[:, :CLOSE], gone)
        changed = _cost(trial, legs)
        if placed and changed < cost - temperatures[iteration] * np.log(np.random.random()):
            cost = changed
            _copy(trial, now)
            if cost < best - 1e-6:
                best = cost
                _copy(now, tours)
        else:
            _copy(now, trial)


@compiled
def _clone(tours: Tours) -> Tours:
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


def improve(search: Search, seed: int) -> None:
    """Offer the search better plans than its own: one from each of :data:`RUNS` runs.

    Parameters
    ----------
    seed
        Of the random numbers, which are the compiled code's own.
    """
    networks = search.networks
    legs = Legs(
        np.array([network.out for network in networks]),
        np.array([np.where(np.isfinite(network.legs), network.legs, FAR) for network in networks]),
        np.array([network.back for network in networks]),
        np.array([network.t_max for network in networks]),
        search.counts[:-1, 1],
        search.prize,
    )
    distance = np.minimum.reduce(legs.between)
    typical = float(np.median(distance.min(axis=1)))
    np.fill_diagonal(distance, -1.0)
    near = np.argsort(distance, axis=1, kind="stable").astype(np.int32)
    remoteness = (legs.out + legs.back).min(axis=0)
    temperatures = typical * np.geomspace(HOT, COLD, ITERATIONS * search.n)

    def run(tours: Tours, number: int) -> None:
        stop = search.clock.stop
        _anneal(tours, legs, near, remoteness, temperatures, RUNS * seed + number, stop)

    plans = [_tours(networks, search.flights) for _ in range(RUNS)]
    try:
        search.clock.map(run, plans, range(RUNS))
    finally:
        for plan in plans:
            search.offer(_flights(plan))


def _tours(networks: list[Network], flights: Sequence[Flight]) -> Tours:
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


def _flights(tours: Tours) -> list[Flight]:
    """Read a plan from linked lists."""
    flights = []
    for r in np.flatnonzero(tours.size):
        path = [int(tours.first[r])]
        while tours.after[path[-1]] >= 0:
            path.append(int(tours.after[path[-1]]))
        flights.append((int(tours.station[r]), tuple(path)))
    return flights
