"""The checker against set-points worked out on paper, and against each way of breaking them."""

from dataclasses import replace
from math import pi, radians

import pytest

from formulations.rotor import MODELS
from windopt.checking import check
from windopt.checking.power_coefficient import CONSTANTS, power_coefficient
from windopt.domain.farm import Farm
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind
from windopt.result import Result, Status

WIND = Wind.from_met(10.0, 350.0)
C_P = power_coefficient("slootweg", 6.91, 0.0)
POWER = 0.5 * 1.065 * 21_900 * 10.0**3 * C_P
FACING = SetPoint("A1", radians(350.0), 0.0, 0.0, 6.91, 10.0, POWER, 1.001 * POWER)
PLAN = YawPlan(Farm("One", (Turbine("A1", 0.0, 0.0),)), WIND, (FACING,), POWER, 1.065)


def broken(**changes):
    return replace(PLAN, set_points=(replace(FACING, **changes),))


def test_a_set_point_worked_out_on_paper_passes():
    report = check(Result(Status.FEASIBLE, PLAN, POWER, 1.001 * POWER, 0.0))
    assert report.passed, report.violations
    assert report.set_points == 1


def test_the_rated_cap_is_held_with_the_wind_to_spare():
    small = replace(SG_8_167, rated_power=0.9 * POWER)
    farm = Farm("One", (Turbine("A1", 0.0, 0.0, small),))
    assert not check(replace(PLAN, farm=farm)).passed


MUTANTS = {
    "not those of the farm's": replace(PLAN, set_points=()),
    "is not a number": broken(power=float("nan")),
    "is not on the compass": broken(nacelle=radians(350.0) - 2 * pi),
    "20 deg is found": broken(nacelle=radians(330.0)),
    "is not the free": broken(wind_speed=11.0),
    "is not between 0": broken(power=8.1e6),
    "outside cut-in and cut-out": replace(
        broken(wind_speed=2.0), wind=Wind.from_met(2.0, 350.0)
    ),
    "above its certified": broken(maximum=0.9 * POWER),
    "Betz limit": broken(maximum=2 * POWER),
    "its set-point gives": broken(power=0.9 * POWER),
    "is said, its set-point": broken(pitch=radians(5.0)),
    "W is said": broken(tip_speed_ratio=4.0),
}  # fmt: skip


@pytest.mark.parametrize("sentence", MUTANTS)
def test_a_broken_set_point_is_rejected(sentence):
    assert any(sentence in violation for violation in check(MUTANTS[sentence]).violations)


@pytest.mark.parametrize("model", CONSTANTS)
def test_both_power_coefficients_agree_though_written_apart(model):
    for tip_speed_ratio in 2.0, 5.0, 8.0, 12.0:
        for pitch in 0.0, 3.0, 12.0, 30.0:
            theirs = float(MODELS[model](tip_speed_ratio, pitch))
            ours = power_coefficient(model, tip_speed_ratio, pitch)
            assert max(ours, 0.0) == pytest.approx(max(theirs, 0.0), abs=1e-12)


def test_an_absurd_wind_is_a_violation_not_an_error():
    assert not check(replace(broken(wind_speed=1e200), wind=Wind.from_met(1e200, 350.0))).passed
