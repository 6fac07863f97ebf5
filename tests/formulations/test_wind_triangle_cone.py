"""The closed form of the wind triangle against the cone program it solves."""

import cvxpy as cp
import numpy as np
import pytest

from formulations.wind_triangle import ground_speed
from formulations.wind_triangle_cone import wind_triangle_cone

U_MAX = 16.0
# Clarabel ends at relative residuals of 1e-8, of sums of 2000 speeds; the worst single leg was off
# by 8e-6 m/s, in calm air.
TOLERANCE = 2e-5  # m/s


@pytest.mark.parametrize("cap", [True, False])
@pytest.mark.parametrize("speed", [0.0, 5.0, 10.0, 15.0, 15.9])
def test_closed_form_solves_the_cone_program_on_2000_random_legs(speed, cap):
    rng = np.random.default_rng(int(10 * speed))
    angle = rng.uniform(0, 2 * np.pi)
    w = speed * np.array([np.cos(angle), np.sin(angle)])
    d = rng.normal(scale=3000.0, size=(2000, 2))
    program = wind_triangle_cone(d, w, U_MAX, cap=cap)
    program.problem.solve(solver=cp.CLARABEL)
    worst = np.abs(program.s.value - ground_speed(d, w, U_MAX, cap=cap)).max()
    assert worst < TOLERANCE


def test_a_leg_that_cannot_be_flown_makes_the_cone_program_infeasible():
    against = np.array([[-1000.0, 0.0]])
    w = np.array([20.0, 0.0])
    program = wind_triangle_cone(against, w, U_MAX)
    program.problem.solve(solver=cp.CLARABEL)
    assert program.problem.status == cp.INFEASIBLE
    assert ground_speed(against, w, U_MAX) == 0.0


def test_storm_legs_that_can_be_flown_agree_too():
    rng = np.random.default_rng(7)
    w = np.array([20.0, 0.0])
    d = rng.normal(size=(400, 2))
    closed = ground_speed(d, w, U_MAX)
    flown = closed > 0.0
    program = wind_triangle_cone(d[flown], w, U_MAX)
    program.problem.solve(solver=cp.CLARABEL)
    assert 0 < flown.sum() < len(d)
    assert np.abs(program.s.value - closed[flown]).max() < TOLERANCE
