"""Wake steering: set-points judged by the exact model, within their bounds and caps."""

from dataclasses import replace
from math import inf, nan, radians

import numpy as np
import pytest

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.io.floris import library_turbine
from windopt.planning.yaw import METHODS, plan_yaw
from windopt.result import Status
from windopt.solving.yaw_bound import BY_INTERVALS

NREL = library_turbine("nrel_5MW")
WEST = Wind.from_met(8.0, 270.0)


def row(n=3, type_=NREL, spacing=5.0):
    d = spacing * type_.rotor_diameter
    return Farm("Row", tuple(Turbine(f"T{i}", d * i, 0.0, type_) for i in range(n)))


def misalignments(result):
    return np.degrees([point.misalignment for point in result.found().set_points])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("speed", [0.0, 2.0, 8.0, 12.0, 26.0])
def test_every_plan_passes_its_check(method, speed):
    result = plan_yaw(row(), Wind.from_met(speed, 272.0), method=method, nacelle=radians(265.0))
    assert check(result).passed, check(result).violations
    assert result.objective <= result.bound * (1 + 1e-12)
    assert result.found().power == result.objective


@pytest.mark.parametrize("method", sorted(set(METHODS) - {"algorithm-1"}))
def test_steering_a_row_pays(method):
    result = plan_yaw(row(), Wind.from_met(8.0, 272.0), method=method)
    assert result.found().gain > 0.2
    assert np.abs(misalignments(result)).max() <= 25.0 + 1e-9
    assert misalignments(result)[-1] == pytest.approx(0.0, abs=1.0)
    assert result.status in (Status.LOCALLY_OPTIMAL, Status.FEASIBLE)
    assert 0 < result.gap < inf


@pytest.mark.parametrize("method", METHODS)
def test_where_all_run_at_rated_power_facing_the_wind_is_proved_optimal(method):
    result = plan_yaw(row(spacing=10.0), Wind.from_met(20.0, 270.0), method=method)
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(15e6)


def test_the_bound_is_that_of_the_farm_and_not_of_the_method():
    results = [plan_yaw(row(), WEST, method=method) for method in METHODS]
    assert len({result.bound for result in results}) == 1
    assert {result.bound_source for result in results} == {BY_INTERVALS}
    assert results[0].bound < 0.9 * sum(p.maximum for p in results[0].found().set_points)


def test_turbines_about_their_rated_power_are_steered_to_a_local_optimum():
    result = plan_yaw(row(8, SG_8_167, spacing=7.0), Wind.from_met(13.0, 272.0))
    assert result.status is Status.LOCALLY_OPTIMAL


def test_the_papers_rule_faces_a_wind_below_rated_and_holds_in_one_above():
    farm = row()
    below = plan_yaw(farm, WEST, nacelle=radians(260.0), method="algorithm-1")
    assert misalignments(below) == pytest.approx(0.0)
    assert below.found().gain == 0.0
    above = plan_yaw(farm, Wind.from_met(14.0, 270.0), nacelle=radians(260.0), method="algorithm-1")
    assert misalignments(above) == pytest.approx(10.0)


def test_the_nacelle_is_the_winds_direction_minus_the_misalignment():
    above = plan_yaw(row(), Wind.from_met(14.0, 5.0), nacelle=radians(355.0), method="algorithm-1")
    nacelles = np.degrees([point.nacelle for point in above.found().set_points])
    assert nacelles == pytest.approx(355.0)
    assert misalignments(above) == pytest.approx(10.0)


def test_the_farms_cap_curtails_turbines_in_proportion():
    free = plan_yaw(row(), WEST, method="algorithm-1").found()
    capped = plan_yaw(row(), WEST, method="algorithm-1", steering=Steering(farm_cap=2e6))
    assert check(capped).passed, check(capped).violations
    assert capped.status is Status.OPTIMAL
    assert capped.objective == pytest.approx(2e6)
    shares = [
        p.power / q.power for p, q in zip(capped.found().set_points, free.set_points, strict=True)
    ]
    assert shares == pytest.approx([2e6 / free.power] * 3)


def test_a_scatter_of_directions_counts_by_its_weights():
    spread = plan_yaw(
        row(), WEST, method="algorithm-1", steering=Steering(direction_std=radians(3.0))
    )
    weights = np.exp(-0.5 * np.arange(-2.0, 3.0) ** 2)
    powers = [
        plan_yaw(row(), Wind.from_met(8.0, 270.0 + 3 * s), method="algorithm-1").objective
        for s in range(-2, 3)
    ]
    assert spread.objective == pytest.approx(weights @ powers / weights.sum())


def test_a_farm_of_the_papers_turbines_needs_no_curves():
    result = plan_yaw(row(type_=SG_8_167), WEST, method="algorithm-1")
    first = result.found().set_points[0]
    assert first.power == pytest.approx(0.5 * 1.225 * 21_900 * 0.441 * 8**3, rel=0.02)
    assert first.wind_speed == pytest.approx(8.0, rel=0.01)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"method": "magic"}, "method to be one of"),
        ({"nacelle": [0.0, 1.0]}, "nacelle to be one direction or 3"),
        ({"air_density": 0.0}, "air_density > 0"),
        ({"time_limit": nan}, "time_limit >= 0 s"),
    ],
)
def test_what_cannot_be_used_is_named(options, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        plan_yaw(row(), WEST, **{"method": "algorithm-1"} | options)


def test_an_unknown_power_coefficient_is_named():
    farm = row(type_=replace(SG_8_167, power_coefficient="mine"))
    with pytest.raises(InvalidInput, match="power_coefficient to be one of"):
        plan_yaw(farm, WEST, method="algorithm-1")


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({"turbulence": 0.0}, "turbulence > 0"),
        ({"lower": 0.3, "upper": 0.2}, "bounds between -90 and 90 deg, the lower first"),
        ({"upper": 1.6}, "bounds between"),
        ({"direction_std": -1.0}, "direction_std >= 0"),
        ({"farm_cap": nan}, "farm_cap >= 0"),
        ({"scenarios": ((WEST, 0.5),)}, "weights of the scenarios >= 0 with sum 1, got 0.5"),
    ],
)
def test_what_no_farm_can_be_steered_under_is_named(options, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        Steering(**options)
