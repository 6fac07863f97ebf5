"""Inspection instances small enough to enumerate, and their enumeration."""

from collections.abc import Callable
from itertools import permutations

import numpy as np
import pytest
from numpy.typing import ArrayLike

from formulations.wind_triangle import flight_time, ground_speed
from windopt.domain.routing import Route, RoutingInstance

U_MAX = 16.0


def instance_under_wind(
    stations: ArrayLike, turbines: ArrayLike, w: ArrayLike = (0.0, 0.0), t_max: float = 1080.0
) -> RoutingInstance:
    """Return the inspection of ``turbines`` [m] from ``stations`` [m] in the wind ``w`` [m/s]."""
    stations, turbines, w = (np.asarray(a, dtype=float) for a in (stations, turbines, w))
    k, n = len(stations), len(turbines)
    places = np.stack([np.vstack([station, turbines]) for station in stations])
    d = places[:, None] - places[:, :, None]
    return RoutingInstance(
        t=flight_time(d, ground_speed(d, w, U_MAX)),
        t_max=np.full(k, t_max),
        stations=stations,
        turbines=turbines,
        w=w,
        allowed=np.ones((k, n), dtype=bool),
        airspeed=np.full(k, U_MAX),
    )


def random_instance(seed: int, n: int = 5, k: int = 2) -> RoutingInstance:
    """Return n turbines and k stations at random in a random wind, all within reach."""
    rng = np.random.default_rng(seed)
    turbines, stations = rng.uniform(0.0, 3000.0, (n, 2)), rng.uniform(0.0, 3000.0, (k, 2))
    angle = rng.uniform(0.0, 2.0 * np.pi)
    w = rng.uniform(0.0, 12.0) * np.array([np.cos(angle), np.sin(angle)])
    farthest = instance_under_wind(stations, turbines, w).round_trip.min(axis=0).max()
    return instance_under_wind(stations, turbines, w, t_max=1.2 * farthest)


def least_total_by_enumeration(instance: RoutingInstance) -> float:
    """Return the least total time [s]: every flight of every set, every partition into sets."""
    k, n = instance.allowed.shape
    everything = 2**n - 1
    flight = [np.inf] * (everything + 1)
    for turbines in range(1, everything + 1):
        for order in permutations(i for i in range(n) if turbines >> i & 1):
            for station in range(k):
                duration = instance.duration(Route(station, order))
                if duration <= instance.t_max[station]:
                    flight[turbines] = min(flight[turbines], duration)
    total = [0.0] + [np.inf] * everything
    for turbines in range(1, everything + 1):
        first = turbines
        while first:  # Every subset of the turbines flies first.
            total[turbines] = min(total[turbines], flight[first] + total[turbines ^ first])
            first = (first - 1) & turbines
    return total[everything]


@pytest.fixture
def under_wind() -> Callable[..., RoutingInstance]:
    return instance_under_wind


@pytest.fixture
def random_flights() -> Callable[..., RoutingInstance]:
    return random_instance


@pytest.fixture
def enumerated() -> Callable[[RoutingInstance], float]:
    return least_total_by_enumeration
