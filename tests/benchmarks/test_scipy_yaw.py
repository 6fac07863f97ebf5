"""SLSQP climbs on the exact wakes, from aside, within bounds and time."""

import numpy as np
import pytest

from benchmarks.scipy_yaw import ASIDE, slsqp
from windopt.solving.farm_yaw import steer
from windopt.wakes.farm import farm_power


@pytest.mark.parametrize("direction", [270.0, 272.0])
def test_three_in_a_row_are_steered_as_well_as_by_the_program(steered, row, direction):
    problem = steered(row(3), direction=direction)
    found = slsqp(problem)
    assert found.objective == pytest.approx(steer(problem).objective, rel=1e-4)
    assert found.objective == pytest.approx(float(farm_power(problem, found.found())), rel=1e-12)
    assert found.objective < found.bound


def test_yaws_stay_within_their_bounds(steered, row):
    problem = steered(row(3), direction=272.0).between(np.zeros(3), np.full(3, np.radians(10.0)))
    yaw = slsqp(problem).found()
    assert ((yaw >= 0.0) & (yaw <= np.radians(10.0))).all()


def test_without_time_the_first_step_is_the_last(steered, row):
    problem = steered(row(3), direction=272.0)
    found = slsqp(problem, time_limit=0.0)
    start = farm_power(problem, np.full(3, ASIDE))
    assert float(start) <= found.objective <= slsqp(problem).objective
