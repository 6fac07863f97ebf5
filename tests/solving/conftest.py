"""Small routing instances drawn at random, and their optimum by enumeration."""

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance


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
    """Least cost by dynamic programming: a station and a flight at a time, then prizes."""
    n = len(instance.turbines)
    best = np.full(2**n, np.inf)  # by the set of turbines inspected
    best[0] = 0.0
    for d in range(len(instance.t)):
        flight = best_flights(instance.t[d], instance.t_max[d], instance.allowed[d])
        most = n if instance.max_flights is None else int(min(n, instance.max_flights[d]))
        for _ in range(most):
            best = one_more(best, flight)
    if instance.prize is None:
        return best[-1]
    left_out = (np.arange(2**n)[:, None] >> np.arange(n)) & 1 == 0
    return (best + left_out @ instance.prize).min()


def one_more(best, flight):
    """Return the least time to inspect each set with at most one flight more."""
    after = best.copy()
    for part in np.flatnonzero(np.isfinite(flight)):
        others = np.flatnonzero((np.arange(len(best)) & part) == 0)
        after[others | part] = np.minimum(after[others | part], best[others] + flight[part])
    return after


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


@pytest.fixture(scope="session")
def small():
    """Hand the functions above to tests."""

    class Small:
        random_instance = staticmethod(random_instance)
        optimum = staticmethod(optimum)
        best_flights = staticmethod(best_flights)

    return Small
