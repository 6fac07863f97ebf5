"""The bound by intervals: above whatever a farm delivers, below the farm without wakes."""

import numpy as np
import pytest

from windopt.solving.compiled_wakes import section, shed
from windopt.solving.farm_yaw import steer
from windopt.solving.wake_intervals import Box, piece, sideways, spread, upwards
from windopt.solving.yaw_bound import yaw_bound
from windopt.wakes.farm import farm_power


@pytest.mark.parametrize("unlike", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_no_yaws_deliver_more(steered, scattered, seed, unlike):
    rng = np.random.default_rng(seed)
    n = 10
    directions, speed = rng.uniform(0, 360, 2), rng.uniform(5, 12)
    problem = steered(scattered(n, seed), direction=directions, speed=speed, unlike=unlike)
    limits = rng.uniform(problem.lower, problem.upper, (2, n))
    problem = problem.between(limits.min(axis=0), limits.max(axis=0))
    yaw = rng.uniform(problem.lower, problem.upper, (500, n))
    bound = yaw_bound(problem)
    assert max(farm_power(problem, yaw).max(), steer(problem).objective) <= bound
    assert bound <= problem.bound


def test_a_box_of_one_yaw_is_bounded_tightly(steered, row):
    p = steered(row(4), direction=271.0)
    yaw = np.full(4, 0.1)
    problem = p.between(yaw, yaw)
    power = float(farm_power(problem, yaw))
    assert power <= yaw_bound(problem) <= 1.02 * power


def test_a_row_of_rotors_cannot_escape_its_wakes(steered, row):
    problem = steered(row(5))
    assert yaw_bound(problem) < 0.75 * problem.bound
    assert yaw_bound(problem) < 1.3 * steer(problem).objective


def test_a_lone_turbine_is_bounded_by_its_most(steered):
    problem = steered([(0.0, 0.0)])
    assert yaw_bound(problem) == pytest.approx(problem.bound, rel=1e-6)


def test_the_cap_bounds_a_farm(steered, row):
    assert yaw_bound(steered(row(3), farm_cap=1e6)) == 1e6


def test_less_room_to_turn_lowers_the_bound(steered, row):
    p = steered(row(5), direction=271.0)
    bounds = [yaw_bound(p.between(*np.radians([[-b] * 5, [b] * 5]))) for b in (2, 8, 16, 25)]
    assert (np.diff(bounds) > 0).all()


@pytest.mark.parametrize("seed", range(20))
def test_intervals_hold_every_wake_within_them(seed):
    rng = np.random.default_rng(seed)
    side = rng.choice([-1, 1])
    gamma = side * np.sort(rng.uniform(0, 0.6, 2))[::side]
    C, I = np.sort(rng.uniform(0.05, 0.95, 2)), np.sort(rng.uniform(0.03, 0.25, 2))  # noqa: E741
    dx, dy, dz = rng.uniform(0.5, 20), rng.uniform(-2, 2), rng.uniform(-1, 1)
    whole = Box(*gamma, *C, *I)
    for _ in range(50):
        i, c = rng.integers(0, 3, 2)
        box = piece(whole, i, c)
        g, t, r = (rng.uniform(box[k], box[k + 1]) for k in (0, 2, 4))
        wake = section(shed(g, t * np.cos(g), r), dx)
        shape = ((dy - wake.delta) / wake.sigma_y) ** 2 + (dz / wake.sigma_z) ** 2
        d = wake.centre * np.exp(-shape / 2)
        s = spread(dx, box)
        (low, high), (low_up, high_up) = sideways(s, dy), upwards(s, dz)
        assert low * low_up * (1 - 1e-9) <= d <= high * high_up * (1 + 1e-9)
