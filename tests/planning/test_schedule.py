"""Schedules: robust to a forecast's spread, no faster than nacelles turn, and worth the trip."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.quantiles import Quantiles
from windopt.domain.steering import Pace, Steering
from windopt.domain.turbine import Turbine
from windopt.domain.wind import WindForecast
from windopt.errors import InvalidInput
from windopt.io.floris import library_turbine
from windopt.planning import yaw
from windopt.planning.schedule import plan_schedule
from windopt.result import Result, Status

NREL = library_turbine("nrel_5MW")
FARM = Farm("Row", tuple(Turbine(f"T{i}", 630.0 * i, 0.0, NREL) for i in range(3)))
START = np.datetime64("2020-01-01T00:00")


def forecast(directions, speed=8.0, spread=None):
    """Return a forecast in steps of 5 minutes, sure of itself unless a spread [rad] is given."""
    n = len(directions)
    quantiles = None
    if spread is not None:
        turns = np.tile(spread * np.array([-1.0, 0.0, 1.0]), (n, 1))
        quantiles = Quantiles((0.1, 0.5, 0.9), np.tile([7.0, 8.0, 9.0], (n, 1)), turns)
    time = START + 5 * np.arange(1, n + 1).astype("m8[m]")
    speeds = np.full(n, speed)
    return WindForecast(START, time, speeds, np.radians(directions), "by hand", quantiles=quantiles)


@pytest.fixture
def turning(monkeypatch):
    """Register a method that turns every rotor as far as it may."""

    def method(problem, *, time_limit, seed):
        return Result(Status.FEASIBLE, problem.upper, 0.0, problem.bound, 0.0)

    monkeypatch.setitem(yaw.METHODS, "turning", method)
    monkeypatch.setattr("windopt.planning.schedule._worth_it", lambda p, g, found, t: found)
    return "turning"


def misalignments(result):
    return np.degrees([point.misalignment for point in result.found().set_points])


def test_every_step_passes_its_check():
    steps = plan_schedule(FARM, forecast([270.0, 275.0, 281.0]), nacelle=radians(268.0))
    assert len(steps) == 3
    for step in steps:
        assert check(step).passed, check(step).violations


def test_nacelles_turn_no_faster_than_they_can(turning):
    pace = Pace(rate=radians(4.0) / 300.0, threshold=0.0)
    steps = plan_schedule(
        FARM, forecast([270.0] * 3), nacelle=radians(270.0), method=turning, pace=pace
    )
    assert [misalignments(step)[0] for step in steps] == pytest.approx([4.0, 8.0, 12.0])


def test_a_nacelle_left_behind_by_the_wind_comes_within_its_bounds(turning):
    pace = Pace(rate=radians(1.0) / 300.0)
    (step,) = plan_schedule(
        FARM, forecast([330.0]), nacelle=radians(270.0), method=turning, pace=pace
    )
    assert misalignments(step) == pytest.approx(25.0)
    assert check(step).passed


SLOW = Pace(rate=radians(2.0) / 300.0, threshold=0.0)
VEERING = [268.0, 269.0, 270.5, 273.0]


def test_slow_nacelles_turn_before_the_wind_in_which_they_stand_aside():
    options = {"nacelle": radians(268.0), "pace": SLOW}
    one_by_one = plan_schedule(FARM, forecast(VEERING), method="serial-refine", **options)
    ahead = plan_schedule(FARM, forecast(VEERING), method="nlp", **options)
    nacelles = np.array([[p.nacelle for p in step.found().set_points] for step in ahead])
    turned = np.diff(np.vstack([np.full(3, radians(268.0)), nacelles]), axis=0)
    assert np.abs(turned).max() <= radians(2.0) + 1e-9
    assert sum(s.objective for s in ahead) > sum(s.objective for s in one_by_one)
    assert all(check(step).passed for step in ahead)


def test_a_wind_that_cannot_be_followed_is_planned_step_by_step():
    options = {"nacelle": radians(268.0), "pace": SLOW, "method": "nlp"}
    steps = plan_schedule(FARM, forecast([268.0, 330.0]), **options)
    assert misalignments(steps[1]) == pytest.approx(25.0)
    assert all(check(step).passed for step in steps)


def test_trips_that_do_not_repay_as_a_whole_are_not_made():
    pace = replace(SLOW, threshold=0.5)
    steps = plan_schedule(FARM, forecast(VEERING), nacelle=radians(268.0), method="nlp", pace=pace)
    nacelles = [point.nacelle for step in steps for point in step.found().set_points]
    assert nacelles == pytest.approx([radians(268.0)] * 12)
    assert {step.status for step in steps} == {Status.FEASIBLE}


def test_what_is_best_within_reach_is_not_called_optimal(monkeypatch):
    def nearest(problem, **_):
        power = float(yaw.farm_power(problem, problem.facing))
        return Result(Status.OPTIMAL, problem.facing, power, power, 0.0)

    monkeypatch.setitem(yaw.METHODS, "nearest", nearest)
    options = {"nacelle": radians(250.0), "pace": SLOW, "method": "nearest"}
    (step,) = plan_schedule(FARM, forecast([270.0]), **options)
    assert step.status is not Status.OPTIMAL
    assert check(step).passed


@pytest.mark.parametrize(("threshold", "first"), [(0.0, 20.0), (0.5, 1.0)])
def test_a_gain_below_the_threshold_moves_no_nacelle(monkeypatch, threshold, first):
    gamma = np.radians([20.0, 15.0, 0.0])
    found = Result(Status.FEASIBLE, gamma, 0.0, np.inf, 0.0)
    monkeypatch.setitem(yaw.METHODS, "steered", lambda problem, **_: found)
    options = {"nacelle": radians(271.0), "method": "steered", "pace": Pace(threshold=threshold)}
    (step,) = plan_schedule(FARM, forecast([272.0]), **options)
    assert misalignments(step)[0] == pytest.approx(first)


def test_the_papers_rule_is_left_as_it_is():
    (rule,) = plan_schedule(FARM, forecast([272.0]), nacelle=radians(271.0), method="algorithm-1")
    assert misalignments(rule) == pytest.approx(0.0)


def test_at_rated_power_nothing_moves():
    steps = plan_schedule(FARM, forecast([10.0, 14.0], speed=20.0), nacelle=radians(5.0))
    assert [misalignments(step)[0] for step in steps] == pytest.approx([5.0, 9.0])


def test_the_spread_of_a_forecast_is_what_a_step_is_robust_to():
    (sure,), (spread,) = (
        plan_schedule(FARM, forecast([270.0], spread=s), nacelle=radians(270.0))
        for s in (None, radians(8.0))
    )
    assert sure.found().steering.scenarios == ()
    scenarios = spread.found().steering.scenarios
    directions = [np.degrees(wind.theta_met) for wind, _ in scenarios]
    assert directions[0] == pytest.approx(262.0)
    assert directions[2] == pytest.approx(270.0)
    assert np.diff(directions) == pytest.approx(np.diff(directions)[::-1])
    assert sum(weight for _, weight in scenarios) == pytest.approx(1.0)
    assert check(spread).passed


def test_a_scatter_of_ones_own_is_kept():
    steering = Steering(direction_std=radians(3.0))
    made = forecast([270.0], spread=0.1)
    (step,) = plan_schedule(FARM, made, nacelle=radians(270.0), steering=steering)
    assert step.found().steering == steering


@pytest.mark.parametrize(
    ("options", "complaint"),
    [({"rate": 0.0}, "rate > 0 rad/s"), ({"threshold": -0.1}, "threshold >= 0")],
)
def test_what_is_no_pace_is_named(options, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        Pace(**options)


def test_levels_between_those_known_are_interpolated():
    made = forecast([270.0], spread=0.1)
    speed, turn = made.quantiles.at((0.1, 0.5, 0.9))
    assert speed == pytest.approx(np.array([[7.0, 8.0, 9.0]]))
    assert turn == pytest.approx(np.array([[-0.1, 0.0, 0.1]]))
    stacked = replace(made.quantiles, speed=np.zeros((2, 1, 3)), turn=np.zeros((2, 1, 3)))
    with pytest.raises(InvalidInput, match="quantiles of one trace"):
        stacked.at((0.5,))
