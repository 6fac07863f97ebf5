"""Better plans: ruin and recreate under simulated annealing.

Strings of neighbouring flights are torn out and their turbines put back one by one where they
cost least, now and then not quite there. The method is slack induction by string removals [1],
with several stations and a limit on the time of a flight in place of one on its load.

* [1] Christiaens & Vanden Berghe (2020), *Transportation Science* 54, 417-433.
"""

# ruff: noqa: NPY002  (compiled code has a generator of its own, which only these names reach)

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.network import SLACK, Floats
from windopt.solving.exact.search import Flight, Search
from windopt.solving.exact.tours import (
    NOWHERE,
    Legs,
    Tours,
    clone,
    copy,
    cost_of,
    detour,
    flights_of,
    insert,
    remove,
    tours_of,
)

REMOVED = 10.0
"""Turbines to tear out in one ruin, on average ([1], section 6.2)."""
STRING = 10
"""Longest string to tear out of one flight ([1], section 6.2)."""
BLINK = 0.01
"""Share of places that a recreation overlooks ([1], section 6.2)."""
ITERATIONS = 150
"""Ruins and recreations for each turbine."""
CLOSE = 16
"""Nearest turbines beside which a turbine is put back; farther ones seldom cost least."""
HOT, WARM, COLD = 5.0, 1.0, 0.03
"""First temperature without and with a good start, and last temperature, as fractions of the
shortest leg of a typical turbine."""


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
            remove(tours, legs, j)
            j = following


@compiled
def _recreate(tours: Tours, legs: Legs, close: Ints, gone: Ints) -> bool:
    """Put each turbine of ``gone`` where it costs least, unless its prize is less.

    Tells whether all that must be inspected found a place.
    """
    sent = np.zeros(len(legs.most))
    for r in range(len(tours.size)):
        if tours.size[r] > 0:
            sent[tours.station[r]] += 1.0
    for i in gone:
        best, flight, behind, station = np.inf, NOWHERE, NOWHERE, NOWHERE
        for j in close[i]:
            r = tours.flight[j]
            if r < 0 or np.random.random() < BLINK:
                continue
            d = tours.station[r]
            room = min(best, legs.t_max[d] - tours.time[r] + SLACK)
            ahead = detour(legs, d, tours.before[j], i, j)
            if ahead < room:
                best, room, flight, behind = ahead, ahead, r, tours.before[j]
            astern = detour(legs, d, j, i, tours.after[j])
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
        insert(tours, legs, i, flight, behind)
    return True


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
    close: Ints,
    remoteness: Floats,
    temperatures: Floats,
    seed: int,
    stop: NDArray[np.uint8],
) -> None:
    """Improve ``tours`` in place, an iteration for each of ``temperatures``."""
    np.random.seed(seed)
    n = len(near)
    now, trial = clone(tours), clone(tours)
    best = cost = cost_of(tours, legs)
    torn = np.full(n, -1, np.int32)
    for iteration in range(len(temperatures)):
        if stop[0] != 0:
            return
        _ruin(trial, legs, near, torn, iteration)
        gone = np.flatnonzero(trial.flight < 0).astype(np.int32)
        _shuffle(gone, remoteness)
        placed = _recreate(trial, legs, close, gone)
        changed = cost_of(trial, legs)
        if placed and changed < cost - temperatures[iteration] * np.log(np.random.random()):
            cost = changed
            copy(trial, now)
            if cost < best - 1e-6:
                best = cost
                copy(now, tours)
        else:
            copy(now, trial)


def improve(
    search: Search, seed: int, effort: int = 1, start: Sequence[Flight] | None = None
) -> None:
    """Offer the search better plans than its own, from two runs side by side.

    Parameters
    ----------
    seed
        Of the random numbers, which are the compiled code's own.
    effort
        Times :data:`ITERATIONS` to spend.
    start
        Flights for one run to begin with, few or many; the other begins with the best plan.
    """
    legs = Legs.of(search)
    distance = np.minimum.reduce(legs.between)
    typical = float(np.median(distance.min(axis=1)))
    np.fill_diagonal(distance, -1.0)
    near = np.argsort(distance, axis=1, kind="stable").astype(np.int32)
    close = np.ascontiguousarray(near[:, 1 : CLOSE + 1])
    remoteness = (legs.out + legs.back).min(axis=0)
    hottest = HOT if start is None else WARM
    temperatures = typical * np.geomspace(hottest, COLD, effort * ITERATIONS * search.n)

    def run(tours: Tours, number: int) -> None:
        stop = search.clock.stop
        _anneal(tours, legs, near, close, remoteness, temperatures, 2 * seed + number, stop)

    starts = (search.flights, search.flights if start is None else start)
    plans = [tours_of(search.networks, flights) for flights in starts]
    try:
        search.clock.map(run, plans, range(len(plans)))
    finally:
        for plan in plans:
            search.offer(flights_of(plan))
