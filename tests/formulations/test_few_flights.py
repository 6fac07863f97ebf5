"""By how much few flights last too long, against every way to fly them."""

from itertools import pairwise, permutations

import numpy as np
import pytest

from formulations.few_flights import few_flights


def least_time(t, m):
    """Return the least time of at most m flights that serve all turbines together."""
    n = len(t) - 1
    stops = [*range(1, n + 1), *[0] * (m - 1)]
    return min(sum(t[i, j] for i, j in pairwise((0, *way, 0))) for way in set(permutations(stops)))


def bound(t, m, t_max=0.0):
    program = few_flights(t, t_max, m)
    program.model.run()
    while program.cut():
        program.model.run()
    return program.model.getInfo().objective_function_value, program.flows()


@pytest.mark.parametrize("m", [1, 2, 3])
@pytest.mark.parametrize("seed", range(10))
def test_no_few_flights_take_less(seed, m):
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, 100, (6, 2))
    leg = xy[None] - xy[:, None]
    t = np.hypot(leg[..., 0], leg[..., 1]) + 0.3 * leg[..., 0]  # legs upwind take longer
    value, x = bound(t, m)
    assert value <= least_time(t, m) + 1e-6
    assert value >= 0.9 * least_time(t, m)
    assert x[0].sum() <= m + 1e-6
    assert x.sum(axis=0)[1:] == pytest.approx(1.0)


def test_one_flight_too_long_is_told_from_two_that_are_not():
    t = np.full((6, 6), 100.0)
    for t_max, excess in [(300.0, 100.0), (310.0, 80.0), (350.0, 0.0), (360.0, -20.0)]:
        assert bound(t, 2, t_max)[0] == pytest.approx(excess)  # 700 s, or 600 s on one flight


def test_turbines_far_from_each_other_take_two_ways_out():
    xy = np.array([[0, 0], [-10, 0], [-10, 1], [10, 0], [10, 1]], float)
    t = np.hypot(*(xy[:, None] - xy[None]).T)
    value, _ = bound(t, 1)
    assert value == pytest.approx(least_time(t, 1))
    assert value > 41.9  # 40 without the rows that join both sides


def test_a_leg_that_cannot_be_flown_is_not():
    t = np.full((4, 4), 5.0)
    t[1, 2] = t[2, 1] = np.inf
    value, x = bound(t, 1)
    assert x[1, 2] == x[2, 1] == 0.0
    assert value == pytest.approx(20.0)
