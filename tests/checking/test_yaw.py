"""The checker on set-points under wakes, and on each way of breaking them."""

from dataclasses import replace
from math import radians

import pytest

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind
from windopt.planning.yaw import plan_yaw
from windopt.result import Result, Status

FARM = Farm("Two", (Turbine("A1", 0.0, 0.0), Turbine("A2", 800.0, 0.0)))
WIND = Wind.from_met(14.0, 268.0)
NACELLE = radians(260.0)  # held, above the rated wind
RESULT = plan_yaw(FARM, WIND, method="algorithm-1", nacelle=NACELLE)
PLAN = RESULT.found()
FIRST, SECOND = PLAN.set_points
CAP = 0.8 * PLAN.power
CAPPED = plan_yaw(
    FARM, WIND, method="algorithm-1", nacelle=NACELLE, steering=Steering(farm_cap=CAP)
).found()


def broken(**changes):
    return replace(PLAN, set_points=(FIRST, replace(SECOND, **changes)))


def test_what_the_exact_model_says_passes():
    report = check(RESULT)
    assert report.passed, report.violations
    assert report.set_points == 2
    assert check(CAPPED).passed


MUTANTS = {
    "not those of the farm's": replace(PLAN, set_points=(FIRST,)),
    "in order": replace(PLAN, set_points=(SECOND, FIRST)),
    "is not a number": broken(power=float("nan")),
    "is not on the compass": broken(nacelle=7.0),
    "8 deg is found": broken(misalignment=radians(9.0)),
    "outside its bounds": replace(PLAN, steering=Steering(upper=radians(5.0))),
    "turned by 90 deg": broken(misalignment=radians(90.0)),
    "wind of 14 m/s is said": broken(wind_speed=14.0),
    "certified maximum of": broken(maximum=1.01 * SECOND.maximum),
    "controller": broken(pitch=0.0),
    "more than the farm's cap": replace(PLAN, steering=Steering(farm_cap=CAP)),
    "W is found": replace(CAPPED, steering=Steering()),
    "for every nacelle facing": replace(PLAN, power_baseline=1.01 * PLAN.power_baseline),
    "a wind of 11.8": replace(PLAN, steering=Steering(turbulence=0.2)),
    "C_p model to be known": replace(
        PLAN, farm=FARM.with_turbine_type(replace(SG_8_167, power_coefficient="mine"))
    ),
    "wind_speeds from 0": replace(PLAN, wind=Wind.from_met(1e200, 268.0)),
}  # fmt: skip


@pytest.mark.parametrize("sentence", MUTANTS)
def test_a_broken_set_point_is_rejected(sentence):
    violations = check(MUTANTS[sentence]).violations
    assert any(sentence in violation for violation in violations), violations


def test_a_set_point_of_a_turbine_alone_is_not_one_under_wakes():
    assert not check(replace(PLAN, steering=None)).passed


def test_a_bound_below_what_facing_the_wind_delivers_is_rejected():
    result = Result(Status.FEASIBLE, PLAN, PLAN.power, 0.99 * PLAN.power, 0.0)
    assert any("W possible" in violation for violation in check(result).violations)


def test_a_plan_short_of_its_bound_cannot_be_called_optimal():
    eight = plan_yaw(FARM, Wind.from_met(8.0, 270.0), method="algorithm-1")
    violations = check(replace(eight, status=Status.OPTIMAL)).violations
    assert any("called optimal at a gap" in violation for violation in violations)
