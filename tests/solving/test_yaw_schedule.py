"""Schedules: no nacelle turns faster than it may, and none loses by looking ahead."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.result import Status
from windopt.solving.farm_yaw import steer
from windopt.solving.yaw_schedule import Window, mean_power, steer_all

TURN = np.radians(2.0)
DIRECTIONS = (268.0, 269.0, 270.5, 273.0)


@pytest.fixture
def problems(steered, row):
    return [steered(row(4), direction=direction) for direction in DIRECTIONS]


def nacelles(problems, yaw):
    return np.array([p.wind_directions[0] for p in problems])[:, None] - yaw


def test_no_nacelle_turns_faster_than_it_may(problems):
    result = steer_all(problems, turn=TURN)
    assert result.status is Status.LOCALLY_OPTIMAL
    turned = np.diff(nacelles(problems, result.found()), axis=0)
    assert np.abs(turned).max() <= TURN + 1e-9
    assert result.objective == pytest.approx(mean_power(problems, result.found()))
    assert result.objective <= result.bound


def test_looking_ahead_gains_on_following(problems):
    alone = np.array([steer(problem).found() for problem in problems])
    followed = mean_power(problems, Window(problems, TURN).nearest(alone))
    assert steer_all(problems, turn=TURN).objective >= followed * (1 - 1e-4)


def test_fast_nacelles_do_as_well_as_each_step_alone(problems):
    alone = np.mean([steer(problem).objective for problem in problems])
    assert steer_all(problems, turn=np.pi).objective == pytest.approx(alone, rel=1e-3)


def test_the_first_step_starts_from_the_present(problems):
    first = replace(problems[0], present=np.full(4, 0.3))
    yaw = steer_all([first, *problems[1:]], turn=TURN).found()
    assert np.abs(yaw[0] - 0.3).max() <= TURN + 1e-9


def test_a_wind_that_turns_too_fast_is_infeasible(steered, row):
    turning = [steered(row(2), direction=direction) for direction in (200.0, 300.0)]
    assert steer_all(turning, turn=TURN).status is Status.INFEASIBLE


def test_no_time_holds_what_can_be_held(problems):
    result = steer_all(problems, turn=TURN, time_limit=0.0)
    assert result.status is Status.FEASIBLE
    assert np.abs(np.diff(nacelles(problems, result.found()), axis=0)).max() <= TURN + 1e-9


def test_bad_input_is_named(problems, steered, row):
    for wrong in ([], [*problems, steered(row(5))]):
        with pytest.raises(InvalidInput, match="problems"):
            steer_all(wrong, turn=TURN)
    with pytest.raises(InvalidInput, match="turn"):
        steer_all(problems, turn=0.0)
