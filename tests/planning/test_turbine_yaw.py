"""Yaw plans: certified, checked, and never above rated."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from math import cos, inf, nan, pi, radians

import numpy as np
import pytest

from formulations.rotor import MODELS
from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning import turbine_yaw
from windopt.planning.turbine_yaw import METHODS, plan_turbine_yaw
from windopt.result import Result, Status

SMALL = replace(SG_8_167.scaled_to(2e6), power_coefficient="heier")
FARM = Farm(
    "Three",
    (Turbine("A1", 0, 0), Turbine("A2", 900, 0, SMALL), Turbine("A3", 0, 900)),
)


def degrees_off(result):
    return np.degrees([point.misalignment for point in result.found().set_points])


@pytest.mark.parametrize("speed", [3.0, 6.0, 11.0, 12.0, 14.0, 24.9])
@pytest.mark.parametrize("name", MODELS)
def test_the_program_is_certified_in_every_wind(name, speed):
    farm = Farm("One", (Turbine("A1", 0, 0, replace(SG_8_167, power_coefficient=name)),))
    for nacelle in None, 0.0, 1.0, 2.5, 4.0, 6.2:
        result = plan_turbine_yaw(farm, Wind.from_met(speed, 10.0), nacelle=nacelle)
        (point,) = result.found().set_points
        assert result.status is Status.OPTIMAL
        assert result.gap <= 1e-6
        assert result.objective <= result.bound
        assert point.power <= SG_8_167.rated_power
        assert check(result).passed, check(result).violations


def test_the_papers_turbine_delivers_the_papers_first_equation():
    """By hand: 0.5 * 1.065 * 21900 * 8^3 * 0.4412 W."""
    farm = Farm("One", (Turbine("A1", 0, 0),))
    result = plan_turbine_yaw(farm, Wind.from_met(8.0, 270.0), nacelle=0.0)
    assert result.objective == pytest.approx(2.634e6, rel=1e-3)
    assert result.found().power_baseline == pytest.approx(result.objective, rel=1e-8)


def test_all_turbines_face_a_wind_below_rated():
    result = plan_turbine_yaw(FARM, Wind.from_met(8.0, 350.0), nacelle=[0.0, radians(170), 4.0])
    assert degrees_off(result) == pytest.approx(0.0, abs=0.004)
    nacelles = [point.nacelle for point in result.found().set_points]
    assert np.degrees(nacelles) == pytest.approx(350.0, abs=0.004)


def test_a_nacelle_moves_only_as_far_as_rated_power_needs():
    result = plan_turbine_yaw(
        FARM, Wind.from_met(14.0, 90.0), nacelle=np.radians([80.0, 80.0, 300.0])
    )
    near, small, far = degrees_off(result)
    assert (near, small) == pytest.approx((10.0, 10.0), abs=1e-3)
    assert abs(far) == pytest.approx(34.16, abs=0.01)  # arccos(11.585 / 14)
    assert result.status is Status.OPTIMAL


def test_the_misalignment_is_wind_minus_nacelle():
    result = plan_turbine_yaw(FARM, Wind.from_met(26.0, 10.0), nacelle=radians(350.0))
    assert degrees_off(result) == pytest.approx(20.0)


@pytest.mark.parametrize("method", METHODS)
def test_turning_wind_and_nacelles_together_changes_no_power(method):
    powers = [
        plan_turbine_yaw(
            FARM, Wind.from_met(13.0, 20.0 + turn), nacelle=radians(350.0 + turn), method=method
        ).objective
        for turn in (0.0, 15.0, 200.0, 360.0)
    ]
    assert np.array(powers) == pytest.approx(powers[0], rel=1e-9)


def test_mirrored_nacelles_mirror_the_plan():
    wind = Wind.from_met(14.0, 0.0)
    right = degrees_off(plan_turbine_yaw(FARM, wind, nacelle=np.radians([20.0, 100.0, 170.0])))
    left = degrees_off(plan_turbine_yaw(FARM, wind, nacelle=np.radians([340.0, 260.0, 190.0])))
    assert right == pytest.approx(-left, abs=1e-3)


@pytest.mark.parametrize("method", METHODS)
def test_power_is_zero_and_the_yaw_held_outside_cut_in_and_cut_out(method):
    for speed in 0.0, 2.99, 25.0, 40.0, 1e50:
        result = plan_turbine_yaw(FARM, Wind.from_met(speed, 90.0), nacelle=1.0, method=method)
        assert result.objective == result.bound == 0.0
        assert result.status is Status.OPTIMAL
        assert [point.nacelle for point in result.found().set_points] == pytest.approx([1.0] * 3)
        assert check(result).passed, check(result).violations


def test_more_wind_below_cut_out_never_yields_less():
    powers = [
        plan_turbine_yaw(FARM, Wind.from_met(speed, 90.0), nacelle=0.0).objective
        for speed in np.linspace(3, 24.9, 40)
    ]
    assert (np.diff(powers) >= -1e-8 * powers[-1]).all()


def test_the_papers_rule_is_compared_with_the_bound():
    result = plan_turbine_yaw(
        FARM, Wind.from_met(14.0, 90.0), nacelle=radians(30.0), method="algorithm-1"
    )
    assert result.status is Status.FEASIBLE
    assert result.gap > 0.1
    assert "old yaw of 3 of 3" in result.reason
    assert degrees_off(result) == pytest.approx(60.0)
    assert check(result).passed, check(result).violations


def test_the_papers_rule_is_optimal_below_rated():
    result = plan_turbine_yaw(FARM, Wind.from_met(9.0, 90.0), nacelle=4.0, method="algorithm-1")
    assert result.status is Status.OPTIMAL
    assert degrees_off(result) == pytest.approx(0.0)


@pytest.mark.parametrize("direction", [0.0, 90.0, 217.3])
def test_the_papers_rule_never_yields_more_than_the_program(direction):
    wind = Wind.from_met(15.0, direction)
    rule = plan_turbine_yaw(FARM, wind, nacelle=[0.5, 2.0, 4.0], method="algorithm-1")
    program = plan_turbine_yaw(FARM, wind, nacelle=[0.5, 2.0, 4.0])
    assert rule.objective <= program.objective
    assert rule.bound == program.bound


def test_a_misaligned_turbine_loses_with_the_cube_of_the_cosine():
    """The paper's table: 6 degrees off turn 129 kWh into 127 kWh."""
    wind = Wind.from_met(12.0, 16.0)
    one = Farm("One", (Turbine("A1", 0, 0, replace(SG_8_167, rated_power=8.8e6)),))
    facing = plan_turbine_yaw(one, wind, nacelle=radians(16.0)).objective
    point = plan_turbine_yaw(one, wind, nacelle=radians(10.0)).found().set_points[0]
    assert facing * cos(radians(6.0)) ** 3 == pytest.approx(facing * 127 / 129, rel=1e-3)
    assert point.power == pytest.approx(facing, rel=1e-8)


def test_no_time_leaves_the_papers_rule_and_says_so():
    wind = Wind.from_met(14.0, 90.0)
    result = plan_turbine_yaw(FARM, wind, nacelle=radians(30.0), time_limit=0.0)
    assert result.status is Status.FEASIBLE
    assert "time limit" in result.reason
    assert result.objective == pytest.approx(
        plan_turbine_yaw(FARM, wind, nacelle=radians(30.0), method="algorithm-1").objective
    )
    assert check(result).passed, check(result).violations


def test_ctrl_c_leaves_the_best_plan_so_far(monkeypatch):
    stopped = Result[np.ndarray](Status.INTERRUPTED, None, inf, -inf, 0.0)
    monkeypatch.setattr(turbine_yaw.nonlinear, "solve", lambda *_, **__: stopped)
    result = plan_turbine_yaw(FARM, Wind.from_met(14.0, 90.0), nacelle=radians(30.0))
    assert result.status is Status.INTERRUPTED
    assert check(result).passed, check(result).violations


def test_equal_turbines_are_solved_once(monkeypatch):
    calls = []
    solve = turbine_yaw.nonlinear.solve
    monkeypatch.setattr(
        turbine_yaw.nonlinear, "solve", lambda *a, **k: calls.append(1) or solve(*a, **k)
    )
    farm = Farm("Many", tuple(Turbine(f"T{i}", 900.0 * i, 0.0) for i in range(165)))
    plan_turbine_yaw(farm, Wind.from_met(9.0, 0.0))
    assert len(calls) == 1


def test_plans_made_in_several_threads_are_those_made_one_by_one():
    winds = [Wind.from_met(speed, 90.0) for speed in np.linspace(4.0, 20.0, 40)]

    def planned(wind):
        return plan_turbine_yaw(FARM, wind, nacelle=[0.5, 2.0, 4.0]).found()

    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(planned, winds)) == [planned(wind) for wind in winds]


def test_further_starts_are_drawn_where_the_bound_is_not_reached(monkeypatch):
    monkeypatch.setattr(turbine_yaw, "GAP", -1.0)  # out of reach
    wind = Wind.from_met(14.0, 90.0)
    results = [plan_turbine_yaw(FARM, wind, nacelle=2.5, seed=seed) for seed in (0, 0, 1)]
    assert {result.status for result in results} == {Status.LOCALLY_OPTIMAL}
    assert results[0].found() == results[1].found()
    assert results[2].objective == pytest.approx(results[2].bound, rel=1e-8)


def test_the_same_inputs_give_the_same_plan():
    wind = Wind.from_met(14.0, 90.0)
    first = plan_turbine_yaw(FARM, wind, nacelle=[0.1, 2.0, 3.0]).found()
    plan_turbine_yaw(FARM, Wind.from_met(7.0, 200.0), nacelle=1.0)
    assert plan_turbine_yaw(FARM, wind, nacelle=[0.1, 2.0, 3.0]).found() == first


@pytest.mark.parametrize(
    ("field", "options"),
    [
        ("method", {"method": "magic"}),
        ("nacelle", {"nacelle": nan}),
        ("nacelle", {"nacelle": [0.0, inf, 0.0]}),
        ("nacelle", {"nacelle": [0.0, 1.0]}),
        ("air_density", {"air_density": 0.0}),
        ("air_density", {"air_density": nan}),
        ("time_limit", {"time_limit": -1.0}),
        ("time_limit", {"time_limit": nan}),
    ],
)
def test_an_option_that_cannot_be_used_is_named(field, options):
    with pytest.raises(InvalidInput) as refusal:
        plan_turbine_yaw(FARM, Wind.from_met(10.0, 0.0), **options)
    assert refusal.value.field == field


def test_an_unknown_method_is_answered_with_the_known_ones():
    with pytest.raises(InvalidInput, match="nlp, algorithm-1"):
        plan_turbine_yaw(FARM, Wind.from_met(10.0, 0.0), method="magic")


@pytest.mark.parametrize("speed", [1.0, 10.0])
def test_an_unknown_power_coefficient_is_named(speed):
    farm = Farm("One", (Turbine("A1", 0, 0, replace(SG_8_167, power_coefficient="mine")),))
    with pytest.raises(InvalidInput, match="power_coefficient"):
        plan_turbine_yaw(farm, Wind.from_met(speed, 0.0))


def test_the_wind_wraps_at_north():
    for direction, nacelle in ((0.0, 2 * pi), (360.0, 0.0), (359.9, radians(0.1))):
        result = plan_turbine_yaw(FARM, Wind.from_met(9.0, direction), nacelle=nacelle)
        assert degrees_off(result) == pytest.approx(0.0, abs=1e-3)
        assert all(0 <= point.nacelle < 2 * pi for point in result.found().set_points)
