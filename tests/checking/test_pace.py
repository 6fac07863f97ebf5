"""Nacelles that turn faster than their plan says they can are found out."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from windopt.checking.pace import too_fast
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.plan import InspectionPlan, Plan, SetPoint, YawPlan
from windopt.domain.steering import Pace, Steering
from windopt.domain.turbine import Turbine
from windopt.domain.wind import WindForecast
from windopt.result import Result, Status

START = np.datetime64("2020-01-01T00:00")
FARM = Farm("One", (Turbine("A1", 0.0, 0.0),))
STEERED = Steering()


def turning(nacelles, directions, steering=STEERED):
    """Return a plan in steps of 100 s, by where its nacelle and the wind come from [deg]."""
    time = START + 100 * np.arange(1, len(nacelles) + 1).astype("m8[s]")
    speed = np.full(len(nacelles), 8.0)
    forecast = WindForecast(START, time, speed, np.radians(directions), "by hand")
    steps = []
    for wind, nacelle, theta in zip(forecast.winds, nacelles, directions, strict=True):
        misalignment = radians((theta - nacelle + 180.0) % 360.0 - 180.0)
        point = SetPoint("A1", radians(nacelle), misalignment, None, None, 8.0, 0.0, 0.0)
        plan = YawPlan(FARM, wind, (point,), 0.0, 1.225, steering)
        steps.append(Result(Status.FEASIBLE, plan, 0.0, 0.0, 0.0))
    fleet = Fleet((Station("S1", 0.0, 0.0),))
    flights = InspectionPlan(FARM, fleet, forecast.mean, (0.0,), ())
    flown = Result(Status.FEASIBLE, flights, 0.0, 0.0, 0.0)
    return Plan(START, forecast, tuple(steps), flown, Pace(rate=radians(0.1)))


@pytest.mark.parametrize("nacelles", [(270.0, 280.0, 270.0), (355.0, 5.0, 355.0)])
def test_a_nacelle_may_turn_as_far_as_it_can(nacelles):
    assert not list(too_fast(turning(nacelles, nacelles)))


@pytest.mark.parametrize("nacelles", [(270.0, 280.1), (355.0, 5.1), (5.1, 355.0)])
def test_a_nacelle_that_turns_further_is_named(nacelles):
    (sentence,) = too_fast(turning(nacelles, nacelles))
    assert "turbine A1: the nacelle turns by 10.1 deg in 100 s" in sentence


def test_one_left_behind_by_the_wind_may_come_within_its_bounds():
    assert not list(too_fast(turning((270.0, 305.0), (270.0, 330.0))))
    assert list(too_fast(turning((270.0, 306.0), (270.0, 330.0))))
    assert list(too_fast(turning((270.0, 305.0), (270.0, 330.0), steering=None)))


def test_a_plan_without_a_pace_says_nothing_of_it():
    assert not list(too_fast(replace(turning((0.0, 90.0), (0.0, 90.0)), pace=None)))
