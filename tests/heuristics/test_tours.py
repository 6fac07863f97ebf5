"""Tours of the UAVs one after the other, and what happens when time or patience runs out."""

from math import inf

import numpy as np
import pytest

from windopt.heuristics import tours
from windopt.heuristics.placement import nearest_stations
from windopt.heuristics.splitting import split_optimally
from windopt.heuristics.tours import fly_tours
from windopt.result import Result, Status


def fly(instance, time_limit=60.0):
    assigned = nearest_stations(instance)
    return fly_tours(instance, assigned, split=split_optimally, time_limit=time_limit, seed=0)


def test_the_shortest_tour_around_a_ring_is_its_perimeter(under_wind):
    angle = 2 * np.pi * np.arange(12) / 12
    ring = 1600.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    result = fly(under_wind(ring[:1], ring[[3, 8, 1, 10, 5, 2, 11, 7, 4, 9, 6]], t_max=1e4))
    assert result.objective == pytest.approx(12 * 2 * np.sin(np.pi / 12) * 100.0)


def test_a_uav_out_of_time_flies_to_the_turbine_soonest_reached(under_wind):
    line = [(3000.0, 0.0), (1000.0, 0.0), (2000.0, 0.0)]
    result = fly(under_wind([(0.0, 0.0)], line), time_limit=0.0)
    assert result.found() == ((0, (1, 2, 0)),)
    assert result.reason == "Tours not proved shortest: 1 of 1."


def test_uavs_without_turbines_stay_on_the_ground(under_wind):
    result = fly(under_wind([(0.0, 0.0), (9000.0, 0.0)], [(100.0, 0.0), (0.0, 100.0)]))
    assert {route.station for route in result.found()} == {0}


def test_after_an_interrupt_the_rest_is_planned_at_once(random_flights, monkeypatch):
    limits = []

    def interrupted(program, *, time_limit, **_):
        limits.append(time_limit)
        return Result(Status.INTERRUPTED, None, inf, -inf, 0.0)

    monkeypatch.setattr(tours, "solve", interrupted)
    instance = random_flights(2, n=9, k=3)
    result = fly(instance)
    assert result.status is Status.INTERRUPTED
    assert limits[0] > 0.0
    assert not any(limits[1:])
    assert sorted(i for route in result.found() for i in route.turbines) == list(range(9))


def test_a_farm_of_165_turbines_and_ten_stations_is_planned_in_seconds(under_wind):
    rng = np.random.default_rng(0)
    grid = np.stack(np.meshgrid(np.arange(15.0), np.arange(11.0)), axis=-1).reshape(-1, 2)
    turbines = 1200.0 * grid + rng.normal(0.0, 100.0, grid.shape)
    stations = turbines[[17, 20, 24, 28, 77, 82, 87, 137, 141, 146]]
    result = fly(under_wind(stations, turbines, (-10.0, 0.0), t_max=1800.0))
    assert result.runtime < 10.0
    assert result.gap < 1.0
