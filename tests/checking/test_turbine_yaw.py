"""The checker against set-points worked out on paper, and against each way of breaking them."""

from dataclasses import replace
from math import cos, pi, radians

import pytest

from formulations.rotor import MODELS
from windopt.checking import check
from windopt.checking.power_coefficient import (
    CONSTANTS,
    largest_power_coefficient,
    power_coefficient,
)
from windopt.domain.farm import Farm
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind
from windopt.result import Result, Status

WIND = Wind.from_met(10.0, 350.0)
FREE = 0.5 * 1.065 * 21_900 * 10.0**3
POWER = FREE * power_coefficient("slootweg", 6.91, 0.0)
MOST = FREE * largest_power_coefficient("slootweg")
FACING = SetPoint("A1", radians(350.0), 0.0, 0.0, 6.91, 10.0, POWER, 1.001 * POWER)
PLAN = YawPlan(Farm("One", (Turbine("A1", 0.0, 0.0),)), WIND, (FACING,), MOST, 1.065)
PARKED = replace(FACING, pitch=radians(90.0), tip_speed_ratio=0.0, power=0.0)


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
    "a power of 0 W is said": broken(power=0.0),
    "W it can deliver": broken(maximum=0.99 * POWER),
    "W is said for every nacelle": replace(PLAN, power_baseline=0.0),
    "W is found": replace(PLAN, power_baseline=1.01 * MOST),
    "pitch of 31 deg": broken(pitch=radians(31.0)),
    "pitch of -2 deg": broken(pitch=radians(-2.0)),
    "pitch of 90 deg": broken(pitch=radians(90.0)),
    "tip-speed ratio of 0 ": broken(tip_speed_ratio=0.0),
    "tip-speed ratio of 16 ": broken(tip_speed_ratio=16.0),
    "its set-point gives 0 W": broken(pitch=radians(90.0), tip_speed_ratio=0.0),
}  # fmt: skip


@pytest.mark.parametrize("sentence", MUTANTS)
def test_a_broken_set_point_is_rejected(sentence):
    assert any(sentence in violation for violation in check(MUTANTS[sentence]).violations)


def test_a_parked_turbine_passes_in_a_calm_and_nowhere_else():
    calm = replace(
        PLAN,
        wind=Wind.from_met(2.0, 350.0),
        set_points=(replace(PARKED, wind_speed=2.0, maximum=0.0),),
        power_baseline=0.0,
    )
    assert check(calm).passed, check(calm).violations
    assert check(replace(PLAN, set_points=(PARKED,))).passed  # wasteful, and said to be
    turning = replace(calm.set_points[0], pitch=0.0, tip_speed_ratio=6.91)
    assert check(replace(calm, set_points=(turning,))).passed


def test_a_wasteful_plan_cannot_be_called_optimal():
    """At 1 rad the turbine delivers cos^3 of it, 16 %, of what it could."""
    wasted = POWER * cos(1.0) ** 3
    point = replace(
        FACING, nacelle=radians(350.0) - 1.0, misalignment=1.0, power=wasted, maximum=wasted
    )
    plan = replace(PLAN, set_points=(point,), power_baseline=0.0)
    said = " ".join(check(Result(Status.OPTIMAL, plan, wasted, wasted, 0.0)).violations)
    for sentence in "W it can deliver", "for every nacelle facing the wind", "W possible":
        assert sentence in said


def test_a_bound_below_what_is_possible_is_rejected_without_any_waste():
    report = check(Result(Status.OPTIMAL, PLAN, POWER, 0.9999 * MOST, 0.0))
    assert any("W possible" in violation for violation in report.violations)


@pytest.mark.parametrize(
    ("model", "largest"),
    [("slootweg", 0.441), ("heier", 0.411), ("mathworks", 0.480), ("dai", 0.4615)],
)
def test_the_largest_power_coefficients_are_the_published_ones(model, largest):
    assert largest_power_coefficient(model) == pytest.approx(largest, abs=1e-3)


@pytest.mark.parametrize("model", CONSTANTS)
def test_both_searches_find_the_same_largest_power_coefficient(model):
    assert largest_power_coefficient(model) == pytest.approx(MODELS[model].best().C_p, rel=1e-9)


@pytest.mark.parametrize("model", CONSTANTS)
def test_both_power_coefficients_agree_though_written_apart(model):
    for tip_speed_ratio in 2.0, 5.0, 8.0, 12.0:
        for pitch in 0.0, 3.0, 12.0, 30.0:
            theirs = float(MODELS[model](tip_speed_ratio, pitch))
            ours = power_coefficient(model, tip_speed_ratio, pitch)
            assert max(ours, 0.0) == pytest.approx(max(theirs, 0.0), abs=1e-12)


def test_an_absurd_wind_is_a_violation_not_an_error():
    assert not check(replace(broken(wind_speed=1e200), wind=Wind.from_met(1e200, 350.0))).passed
