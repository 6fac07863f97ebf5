"""Grown sets: turbines that seem to need more flights than a fractional plan sends there.

A set grows from each turbine by the one most strongly tied to it. One tour through the set grows
with it, by cheapest insertion and moves of single turbines, and tells how many flights the set
seems to need. That is a guess, to be proved before it is used.
"""

# ruff: noqa: NPY002  (compiled code has a generator of its own, which only these names reach)

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.network import SLACK, Bools, Floats

TRIES = 4
"""Sets to grow from each turbine; all but the first choose among strong ties at random."""
NOISE = 0.6
"""How much stronger than it is chance may make a tie."""
LARGEST = 40
"""Turbines in a set."""
SHORT = 0.05
"""Flights that must be lacking."""

Tour = NDArray[np.int64]


class Flow(NamedTuple):
    """How much of a fractional plan's flights goes where.

    Attributes
    ----------
    ties
        Between two turbines, either way, shape ``(n, n)``.
    arriving
        At each turbine, shape ``(n,)``.
    """

    ties: Floats
    arriving: Floats


class Grown(NamedTuple):
    """Sets of turbines, the flights that each seems to need, and how many of them are lacking."""

    sets: Bools
    need: Tour
    lacking: Floats


@compiled
def _detour(t: Floats, a: int, j: int, b: int) -> float:
    return float(t[a, j] + t[j, b] - t[a, b])


@compiled
def _best_place(tour: Tour, size: int, j: int, t: Floats) -> tuple[int, float]:
    """Return the place of a tour that has j at its end in which j costs least, and the cost.

    Turbine j is the one after the first ``size``; the tour starts and ends at the last node.
    """
    best, place, a = np.inf, 0, len(t) - 1
    for p in range(size + 1):
        b = tour[p] if p < size else len(t) - 1
        cost = _detour(t, a, j, b)
        if cost < best:
            best, place = cost, p
        a = b
    return place, best


@compiled
def _shift(tour: Tour, old: int, new: int) -> None:
    """Move the turbine at place ``old`` to place ``new``."""
    j, step = tour[old], 1 if new > old else -1
    for p in range(old, new, step):
        tour[p] = tour[p + step]
    tour[new] = j


@compiled
def _shorten(tour: Tour, size: int, t: Floats) -> float:
    """Move single turbines while that saves time, and return how much it saves."""
    saved, better = 0.0, True
    while better:
        better = False
        for p in range(size):
            j = tour[p]
            before = tour[p - 1] if p > 0 else len(t) - 1
            after = tour[p + 1] if p < size - 1 else len(t) - 1
            now = _detour(t, before, j, after)
            _shift(tour, p, size - 1)
            place, cost = _best_place(tour, size - 1, j, t)
            if cost < now - 1e-9:
                saved, better = saved + now - cost, True
                _shift(tour, size - 1, place)
            else:
                _shift(tour, size - 1, p)
    return saved


@compiled
def _flights(tour: Tour, size: int, time: float, t: Floats, longest: float) -> int:
    """Return how many flights a tour seems to need: each more adds a detour by the station."""
    home, station = np.inf, len(t) - 1
    for p in range(1, size):
        home = min(home, _detour(t, tour[p - 1], station, tour[p]))
    need = 1
    while need < size:
        detours = (need - 1) * home if need > 1 else 0.0
        if time + detours <= need * (longest + SLACK):
            break
        need += 1
    return need


@compiled
def _strongest(ties: Floats, inside: Bools, usable: Bools, noise: float) -> int:
    """Return the turbine most strongly tied to a set, or -1."""
    best, chosen = 0.0, -1
    for i in range(len(ties)):
        if usable[i] and not inside[i]:
            tie = ties[i] * (1.0 + noise * np.random.random())
            if tie > best:
                best, chosen = tie, i
    return chosen


@compiled
def _grow(
    found: Grown, count: int, flow: Flow, t: Floats, longest: float, usable: Bools, first: int,
    noise: float,
) -> int:  # fmt: skip
    """Grow a set from turbine ``first``; return how many sets are found with it."""
    inside, ties = np.zeros(len(usable), np.bool_), np.zeros(len(usable))
    tour, size, time = np.zeros(LARGEST, np.int64), 0, 0.0
    inflow, told, j = 0.0, 1, first
    while j >= 0 and size < LARGEST:
        inside[j] = True
        inflow += flow.arriving[j] - ties[j]
        ties += flow.ties[j]
        place, cost = _best_place(tour, size, j, t)
        tour[size] = j
        _shift(tour, size, place)
        size += 1
        time += cost - _shorten(tour, size, t)
        need = _flights(tour, size, time, t, longest)
        if need > told and need - inflow > SHORT and count < len(found.need):
            found.sets[count], found.need[count], found.lacking[count] = inside, need, need - inflow
            count, told = count + 1, need
        j = _strongest(ties, inside, usable, noise)
    return count


@compiled
def grown_sets(
    flow: Flow,
    t: Floats,
    longest: float,
    usable: Bools,
    seed: int,
    stop: NDArray[np.uint8],
) -> Grown:
    """Return sets that seem to need more flights than the plan sends there.

    Parameters
    ----------
    t
        Times between turbines, and from and to a station, which is the last; of flights at least as
        fast as any.
    longest
        How long a flight may last.
    usable
        Which turbines a set may have, shape ``(n,)``.
    seed
        Of the random numbers, which are the compiled code's own.
    stop
        Ends the search when it is not 0.
    """
    np.random.seed(seed)
    n = len(usable)
    most = TRIES * n * 4
    found = Grown(np.zeros((most, n), np.bool_), np.zeros(most, np.int64), np.zeros(most))
    count = 0
    for attempt in range(TRIES):
        noise = NOISE if attempt else 0.0
        for first in range(n):
            if usable[first] and stop[0] == 0:
                count = _grow(found, count, flow, t, longest, usable, first, noise)
    return Grown(found.sets[:count], found.need[:count], found.lacking[:count])
