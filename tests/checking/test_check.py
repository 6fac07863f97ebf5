"""The checker against whole plans: each step of the forecast has its set-points, in time."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.plan import Flight, InspectionPlan, Plan, SetPoint, YawPlan
from windopt.domain.steering import Pace
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind, WindForecast
from windopt.result import Result, Status

FARM = Farm("One", (Turbine("A1", 0.0, 800.0),))
START = np.datetime64("2011-04-13T22:00")
FORECAST = WindForecast(
    START,
    START + np.array([5, 10, 15]).astype("m8[m]"),
    np.array([2.0, 1.0, 2.0]),  # calms, in which the turbine is parked
    np.radians([90.0, 90.0, 90.0]),
    "by hand",
)


def parked(wind):
    point = SetPoint("A1", wind.theta_met, 0.0, np.pi / 2, 0.0, wind.speed, 0.0, 0.0)
    return Result(Status.OPTIMAL, YawPlan(FARM, wind, (point,), 0.0, 1.065), 0.0, 0.0, 0.0)


def flown(wind):
    leg = 800.0 / np.sqrt(16.0**2 - wind.speed**2)  # northward in an east wind
    flight = Flight("S1", "AscTec Falcon 8", ("A1",), (leg, leg), 2 * leg)
    plan = InspectionPlan(FARM, Fleet((Station("S1", 0.0, 0.0),)), wind, (0.0,), (flight,))
    return Result(Status.FEASIBLE, plan, 2 * leg, 0.0, 0.0)


PLAN = Plan(
    START, FORECAST, tuple(parked(wind) for wind in FORECAST.winds), flown(FORECAST.mean)
)  # fmt: skip


def test_nacelles_of_a_whole_plan_keep_its_pace():
    away = replace(PLAN.yaw[1].solution.set_points[0], nacelle=0.0, misalignment=np.pi / 2)
    turned = replace(PLAN.yaw[1], solution=replace(PLAN.yaw[1].solution, set_points=(away,)))
    plan = replace(PLAN, yaw=(PLAN.yaw[0], turned, PLAN.yaw[2]), pace=Pace(rate=0.001))
    assert any("22:10: turbine A1: the nacelle turns by 90" in v for v in check(plan).violations)


def test_a_whole_plan_worked_out_on_paper_passes():
    report = check(PLAN)
    assert report.passed, report.violations
    assert (report.flights, report.set_points) == (1, 3)


MUTANTS = {
    "2 yaw steps for 3 steps": replace(PLAN, yaw=PLAN.yaw[:2]),
    "4 yaw steps for 3 steps": replace(PLAN, yaw=(*PLAN.yaw, PLAN.yaw[0])),
    "yaw at 2011-04-13T22:10: the wind is not that": replace(PLAN, yaw=(PLAN.yaw[0],) * 3),
    "the wind is not the forecast's mean": replace(PLAN, inspection=flown(Wind(-3.0, 0.0))),
    "time 2011-04-13T22:05 is not after 2011-04-13T22:10": replace(
        PLAN, forecast=replace(FORECAST, time=FORECAST.time[[1, 0, 2]])
    ),
    "time 2011-04-13T22:10 is not after 2011-04-13T22:10": replace(
        PLAN, forecast=replace(FORECAST, time=FORECAST.time[[0, 1, 1]])
    ),
    "time 2011-04-13T22:05 is not after 2011-04-13T22:05": replace(
        PLAN, forecast=replace(FORECAST, issued=FORECAST.time[0])
    ),
    "yaw at 2011-04-13T22:15: there is no plan": replace(
        PLAN, yaw=(*PLAN.yaw[:2], Result(Status.NO_SOLUTION, None, 0.0, 0.0, 0.0))
    ),
}


@pytest.mark.parametrize("sentence", MUTANTS)
def test_a_broken_whole_plan_is_rejected(sentence):
    assert any(sentence in violation for violation in check(MUTANTS[sentence]).violations)
