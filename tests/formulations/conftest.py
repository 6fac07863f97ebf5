"""What tests of routing share: random instances, and their optimum by enumeration."""

from itertools import combinations
from math import inf

import numpy as np
import pytest

from formulations.wind_triangle import flight_time, ground_speed, ground_speed_paper

ROUNDING = 1e-9


def flight_times(stations, turbines, w, u_max=16.0, dwell=0.0, speed=ground_speed):
    """Return the times between each station and the turbines [s]."""
    times = []
    for station in stations:
        nodes = np.vstack([station, turbines])
        d = nodes[None] - nodes[:, None]
        t = flight_time(d, speed(d, np.asarray(w, dtype=float), u_max))
        t[:, 1:] += dwell
        times.append(t)
    return np.array(times)


def random_instance(seed, turbines=7, stations=3, rule=ground_speed):
    """Draw t, t_max and allowed: any wind, dwell, UAVs that differ, some of it infeasible."""
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(1, turbines + 1)), int(rng.integers(1, stations + 1))
    angle, speed = (
        rng.uniform(0, 2 * np.pi),
        rng.choice([0.0, rng.uniform(0, 15.9), 18.0], p=[0.1, 0.8, 0.1]),
    )
    places = rng.uniform(0, 6000, (n + k, 2))
    t = np.concatenate(
        [
            flight_times(
                places[d : d + 1],
                places[k:],
                speed * np.array([np.cos(angle), np.sin(angle)]),
                u_max=rng.choice([14.0, 16.0]),
                dwell=rng.choice([0.0, 60.0]),
                speed=rule,
            )
            for d in range(k)
        ]
    )
    return t, *_limits(t, rng)


def random_times(seed, turbines=7, stations=3):
    """Draw t, t_max and allowed without a geography: detours are faster than many a leg."""
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(2, turbines + 1)), int(rng.integers(1, stations + 1))
    t = rng.uniform(10.0, 600.0, (k, n + 1, n + 1))
    t[rng.uniform(size=t.shape) < 0.05] = inf
    return t, *_limits(t, rng)


def _limits(t, rng):
    """Draw t_max and allowed for flights that take t."""
    k, n = len(t), t.shape[1] - 1
    round_trips = (t[:, 0, 1:] + t[:, 1:, 0]).min(axis=0)
    longest = round_trips[np.isfinite(round_trips)].max(initial=100.0)
    t_max = longest * rng.uniform(0.95, 2.5) * rng.choice([1.0, 1.2], size=k)
    return t_max, rng.uniform(size=(k, n)) < 0.95


def random_paper_instance(seed, turbines=7, stations=3):
    """Draw the same by the paper's rule for the speed, which breaks the triangle inequality."""
    return random_instance(seed, turbines, stations, rule=ground_speed_paper)


INSTANCES = {  # of the times, with and without the triangle inequality
    "wind": random_instance,
    "paper": random_paper_instance,
    "any": random_times,
}


def cheapest(t, t_max, allowed=None):
    """Least total time of flights that serve every turbine once, ``inf`` if there are none.

    The cheapest flight for each set of turbines by dynamic programming over its subsets, then
    the cheapest partition into such sets; no program and no solver.
    """
    k, n = len(t), t.shape[1] - 1
    t_max = np.broadcast_to(t_max, k)
    flight = [inf] * 2**n
    for d in range(k):
        serves = [i for i in range(n) if allowed is None or allowed[d, i]]
        path = {(1 << i, i): t[d, 0, i + 1] for i in serves}
        for size in range(1, len(serves) + 1):
            for members in combinations(serves, size):
                S = sum(1 << i for i in members)
                for j in members if size > 1 else ():
                    rest = S & ~(1 << j)
                    path[S, j] = min(path[rest, i] + t[d, i + 1, j + 1] for i in members if i != j)
                duration = min(path[S, j] + t[d, j + 1, 0] for j in members)
                if duration <= t_max[d] * (1 + ROUNDING):
                    flight[S] = min(flight[S], duration)
    best = [0.0] + [inf] * (2**n - 1)
    for S in range(1, 2**n):
        first, part = S & -S, S
        while part:
            if part & first:
                best[S] = min(best[S], flight[part] + best[S ^ part])
            part = (part - 1) & S
    return best[-1]


@pytest.fixture
def routing():
    """Hand the functions above to tests."""

    class Routing:
        flight_times = staticmethod(flight_times)
        random_instance = staticmethod(random_instance)
        instances = INSTANCES
        cheapest = staticmethod(cheapest)

    return Routing
