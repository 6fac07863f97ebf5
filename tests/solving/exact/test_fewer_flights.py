"""Flights that cost nothing more as one are one."""

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact.fewer_flights import fewer_flights
from windopt.solving.exact.network import networks


def at_the_foot(t_max, dwell=0.0):
    """Return a farm in a row whose station stands at the first turbine."""
    x = np.array([0.0, 0.0, 100.0, 200.0])  # the station, then the turbines
    t = np.abs(x[None] - x[:, None])
    t[:, 1:] += dwell
    turbines = np.column_stack([x[1:], np.zeros(3)])
    allowed = np.ones((1, 3), bool)
    return RoutingInstance(
        t[None], np.array([t_max]), np.zeros((1, 2)), turbines, np.zeros(2), allowed
    )


@pytest.mark.parametrize("dwell", [0.0, 10.0])
def test_a_turbine_at_the_station_is_inspected_on_the_way(dwell):
    result = column_generation(at_the_foot(1000.0, dwell))
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(400.0 + 3 * dwell)
    assert len(result.found()) == 1


def test_flights_that_are_too_long_as_one_stay_apart():
    made, unit = networks(at_the_foot(425.0, 10.0))
    apart = [(0, (0,)), (0, (1, 2))]
    assert fewer_flights(apart, made) == apart
    assert sum(made[0].duration(path) for _, path in apart) * unit == pytest.approx(430.0)


def test_flights_that_are_longer_as_one_stay_apart():
    instance = at_the_foot(1000.0)
    instance.t[0, 1, 2] = instance.t[0, 1, 3] = 150.0  # from the turbine at the station: no way
    instance.t[0, 2, 1] = instance.t[0, 3, 1] = 250.0
    made, _ = networks(instance)
    apart = [(0, (0,)), (0, (1, 2))]
    assert fewer_flights(apart, made) == apart


def test_flights_of_other_stations_stay_apart(small):
    instance = small.random_instance(412)
    made, _ = networks(instance)
    apart = [(d, (d,)) for d in range(len(made))]
    assert len(fewer_flights(apart, made)) == len(apart)
