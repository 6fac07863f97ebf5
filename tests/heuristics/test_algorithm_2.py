"""Algorithm 2 and its baseline against enumeration, symmetry and the paper's example."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.heuristics.baseline import baseline
from windopt.heuristics.splitting import split_by_rule, split_optimally
from windopt.result import Status

METHODS = [algorithm_2, baseline]
EAST_WIND = (-10.0, 0.0)


def visited(result):
    return sorted(turbine for route in result.found() for turbine in route.turbines)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("split", [split_by_rule, split_optimally])
@pytest.mark.parametrize("seed", range(10))
def test_a_plan_visits_every_turbine_once_within_the_limits(random_flights, method, split, seed):
    instance = random_flights(seed, n=9, k=3)
    result = method(instance, split=split)
    assert visited(result) == list(range(9))
    assert all(instance.duration(r) <= instance.t_max[r.station] for r in result.found())
    assert result.objective == pytest.approx(instance.total(result.found()))
    assert result.bound <= result.objective
    assert result.status is not Status.OPTIMAL or result.gap < 1e-6


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("seed", range(15))
def test_no_plan_is_shorter_than_the_optimum(random_flights, enumerated, method, seed):
    instance = random_flights(seed, n=5, k=1 + seed % 2)
    assert method(instance).objective >= enumerated(instance) * (1 - 1e-9)


def test_a_farm_that_one_flight_can_inspect_is_solved_to_the_optimum(random_flights, enumerated):
    small = random_flights(0, n=5, k=1)
    instance = replace(small, t_max=np.array([1e5]))
    assert algorithm_2(instance).objective == pytest.approx(enumerated(instance))


@pytest.mark.parametrize("method", METHODS)
def test_a_single_turbine_is_flown_to_and_back_and_proved_optimal(under_wind, method):
    result = method(under_wind([(0.0, 0.0)], [(1600.0, 0.0)]))
    assert result.found() == ((0, (0,)),)
    assert result.objective == pytest.approx(200.0)
    assert result.status is Status.OPTIMAL


def test_the_upwind_turbine_goes_to_the_station_on_its_other_side(under_wind):
    """The paper's example in small: it costs its own UAV a flight, and the other a short detour."""
    stations = [(0.0, 0.0), (7000.0, 0.0)]
    turbines = [(-2000.0, 0.0), (-2000.0, 1500.0), (3300.0, 0.0), (4000.0, 0.0)]
    instance = under_wind(stations, turbines, EAST_WIND)
    half_a_flight = (16.0 + 10.0) * 540.0
    moved = algorithm_2(instance, flying_range=half_a_flight)
    kept = baseline(instance)
    assert {r.station for r in kept.found() if 2 in r.turbines} == {0}
    assert {r.station for r in moved.found() if 2 in r.turbines} == {1}
    assert "reassigned: 1." in moved.reason
    assert moved.objective < kept.objective


@pytest.mark.parametrize("method", METHODS)
def test_a_turbine_its_uav_cannot_reach_is_given_to_one_that_can(under_wind, method):
    instance = under_wind([(0.0, 0.0), (4000.0, 0.0)], [(100.0, 0.0), (3900.0, 0.0)], t_max=400.0)
    result = method(instance, assigned=np.array([0, 0]))
    assert sorted(result.found()) == [(0, (0,)), (1, (1,))]
    assert "reassigned: 1." in result.reason


@pytest.mark.parametrize("method", METHODS)
def test_a_turbine_that_nobody_reaches_is_refused(under_wind, method):
    with pytest.raises(InvalidInput, match="within reach of a station"):
        method(under_wind([(0.0, 0.0)], [(90_000.0, 0.0)]))


@pytest.mark.parametrize("method", METHODS)
def test_no_time_still_gives_a_plan_and_says_so(random_flights, method):
    result = method(random_flights(1, n=9, k=2), time_limit=0.0)
    assert visited(result) == list(range(9))
    assert "not proved shortest" in result.reason


@pytest.mark.parametrize("seed", range(5))
def test_moving_and_turning_farm_and_wind_changes_nothing(random_flights, under_wind, seed):
    a = random_flights(seed, n=7)
    c, s = np.cos(0.7), np.sin(0.7)
    turn = np.array([(c, s), (-s, c)])
    shift = np.array([4e5, 6e6])
    t_max = a.t_max[0] * (1 + 1e-9)  # So that rounding cannot put the farthest out of reach.
    b = under_wind(a.stations @ turn + shift, a.turbines @ turn + shift, a.w @ turn, t_max)
    assert algorithm_2(b).objective == pytest.approx(algorithm_2(a).objective)


@pytest.mark.parametrize("seed", range(5))
def test_the_order_of_turbines_and_stations_changes_nothing(random_flights, under_wind, seed):
    a = random_flights(seed, n=7)
    order = np.random.default_rng(seed).permutation(7)
    b = under_wind(a.stations[::-1], a.turbines[order], a.w, a.t_max[0])
    assert algorithm_2(b).objective == pytest.approx(algorithm_2(a).objective)
