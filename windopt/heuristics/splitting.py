"""Cutting one long tour into flights that a battery lasts for.

Both ways keep the order of the tour. The paper's rule flies on as long as it can; the optimal
way weighs all cuts (Beasley 1983, *Omega* 11, 403-408) and is never longer.
"""

from collections.abc import Callable, Iterator, Sequence
from math import inf
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput

Flights: TypeAlias = list[tuple[int, ...]]
Split: TypeAlias = Callable[[Sequence[int], NDArray[np.float64], float], Flights]


def split_by_rule(order: Sequence[int], t: NDArray[np.float64], t_max: float) -> Flights:
    """Fly along the tour, and home when the next turbine and the way back would take too long.

    Parameters
    ----------
    order
        Turbines in the order of the tour, from 0.
    t
        Time from leaving i until done at j [s], shape ``(n + 1, n + 1)``, node 0 the station.
    t_max
        Longest flight [s].

    Raises
    ------
    InvalidInput
        If a turbine's own round trip takes longer than ``t_max``.
    """
    _require_round_trips(order, t, t_max)
    flights: Flights = []
    first = 0
    while first < len(order):
        last = first + 1
        for end, _ in _flights_from(first, order, t, t_max):
            if end > last + 1:
                break  # A turbine was too far, though one after it would not be.
            last = end
        flights.append(tuple(order[first:last]))
        first = last
    return flights


def split_optimally(order: Sequence[int], t: NDArray[np.float64], t_max: float) -> Flights:
    """Cut the tour into flights of the least total time.

    A shortest path over the cuts: from cut a to cut b leads the flight that visits the turbines
    between them, where it is short enough.

    Parameters
    ----------
    order
        Turbines in the order of the tour, from 0.
    t
        Time from leaving i until done at j [s], shape ``(n + 1, n + 1)``, node 0 the station.
    t_max
        Longest flight [s].

    Raises
    ------
    InvalidInput
        If a turbine's own round trip takes longer than ``t_max``.
    """
    _require_round_trips(order, t, t_max)
    least = [0.0] + [inf] * len(order)  # Time to visit all turbines before each cut.
    before = [0] * (len(order) + 1)  # The cut from which that is reached.
    for a in range(len(order)):
        for b, duration in _flights_from(a, order, t, t_max):
            if least[a] + duration < least[b]:
                least[b], before[b] = least[a] + duration, a

    flights: Flights = []
    end = len(order)
    while end:
        flights.append(tuple(order[before[end] : end]))
        end = before[end]
    return flights[::-1]


def _flights_from(
    first: int, order: Sequence[int], t: NDArray[np.float64], t_max: float
) -> Iterator[tuple[int, float]]:
    """Yield each flight ``order[first:end]`` that is short enough, as its end and duration."""
    here, out = 0, 0.0
    for end, turbine in enumerate(order[first:], start=first + 1):
        out += t[here, turbine + 1]
        here = turbine + 1
        if out > t_max:
            return
        if out + t[here, 0] <= t_max:
            yield end, float(out + t[here, 0])


def _require_round_trips(order: Sequence[int], t: NDArray[np.float64], t_max: float) -> None:
    for turbine in order:
        round_trip = t[0, turbine + 1] + t[turbine + 1, 0]
        if round_trip > t_max:
            raise InvalidInput(f"round trip to turbine {turbine}", f"<= {t_max} s", round_trip)
