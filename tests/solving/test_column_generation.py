"""Column generation against all subsets of turbines, and against itself in other clothes."""

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation


def best_flights(t, t_max, allowed):
    """Time of the fastest flight of one station over each set of turbines, inf where none fits."""
    n = len(t) - 1
    reached = np.full((2**n, n), np.inf)  # by set and last turbine
    for j in range(n):
        if allowed[j]:
            reached[1 << j, j] = t[0, j + 1]
    members = (np.arange(2**n)[:, None] >> np.arange(n)) & 1 == 1
    for mask in range(1, 2**n):
        arrive = (reached[mask][:, None] + t[1:, 1:]).min(axis=0)
        for j in np.flatnonzero(~members[mask] & allowed):
            larger = mask | 1 << j
            reached[larger, j] = min(reached[larger, j], arrive[j])
    total = (reached + t[1:, 0]).min(axis=1)
    return np.where(total <= t_max, total, np.inf)


def optimum(instance):
    """Least total time: the best partition of all turbines into flights, by dynamic programming."""
    n = len(instance.turbines)
    stations = zip(instance.t, instance.t_max, instance.allowed, strict=True)
    flight = np.min([best_flights(*station) for station in stations], axis=0)
    best = np.full(2**n, np.inf)
    best[0] = 0.0
    for mask in range(1, 2**n):
        lowest = mask & -mask
        part = mask
        while part:
            if part & lowest:
                best[mask] = min(best[mask], flight[part] + best[mask ^ part])
            part = (part - 1) & mask
    return best[-1]


def random_instance(seed, most=9):
    """Return an instance with winds, dwells, airspeeds, limits and permissions drawn at random."""
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(1, most + 1)), int(rng.integers(1, 4))
    turbines, stations = rng.uniform(0, 5000, (n, 2)), rng.uniform(0, 5000, (k, 2))
    wind = rng.uniform(0, 12)
    angle = rng.uniform(0, 2 * np.pi)
    w = wind * np.array([np.cos(angle), np.sin(angle)])
    dwell = rng.choice([0.0, 1.0]) * rng.uniform(0, 120, n)
    t = np.empty((k, n + 1, n + 1))
    for d in range(k):
        airspeed = rng.uniform(13, 20)
        nodes = np.vstack([stations[d : d + 1], turbines])
        leg = nodes[None] - nodes[:, None]
        length = np.hypot(leg[..., 0], leg[..., 1])
        unit = leg / np.where(length > 0, length, 1.0)[..., None]
        cross = unit[..., 0] * w[1] - unit[..., 1] * w[0]
        speed = unit @ w + np.sqrt(airspeed**2 - cross**2)
        t[d] = np.where(length > 0, length / np.minimum(speed, airspeed), 0.0)
        t[d, :, 1:] += np.where(length[:, 1:] > 0, dwell, 0.0)
    allowed = rng.random((k, n)) < rng.choice([0.7, 1.0])
    trips = np.where(allowed, t[:, 0, 1:] + t[:, 1:, 0], np.inf)
    needed = trips.min(axis=0)[np.isfinite(trips.min(axis=0))].max(initial=1.0)
    t_max = needed * rng.uniform(0.95, 2.5, k)
    return RoutingInstance(t, t_max, stations, turbines, w, allowed)


def duration_is_kept(instance, routes):
    for route in routes:
        assert instance.duration(route) <= instance.t_max[route.station] * (1 + 1e-9)
        assert instance.allowed[route.station, list(route.turbines)].all()
    visited = sorted(i for route in routes for i in route.turbines)
    assert visited == list(range(len(instance.turbines)))


@pytest.mark.parametrize("seed", range(200))
def test_optimum_equals_enumeration(seed):
    instance = random_instance(seed)
    best = optimum(instance)
    result = column_generation(instance)
    if np.isinf(best):
        assert result.status is Status.INFEASIBLE
        return
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(best, rel=1e-9)
    assert result.bound == pytest.approx(best, rel=1e-8)
    assert instance.total(result.solution) == pytest.approx(best, rel=1e-9)
    duration_is_kept(instance, result.solution)
