"""Reassignment: who gives turbines, who takes them, and who keeps them."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.heuristics.reassignment import reassign


@pytest.fixture
def three_stations(under_wind):
    """Stations at 0, 1 and 2 km and turbines at 0.1, 0.9 and 1.9 km along one line."""
    stations = [(0.0, 0.0), (1000.0, 0.0), (2000.0, 0.0)]
    return under_wind(stations, [(100.0, 0.0), (900.0, 0.0), (1900.0, 0.0)])


def ranges(*rows):
    return np.array(rows, dtype=bool)


def test_turbines_in_range_stay_even_where_another_is_nearer(three_stations):
    assigned = np.array([2, 0, 0])
    Z = ranges((1, 1, 1), (1, 1, 1), (1, 1, 1))
    assert reassign(three_stations, assigned, Z).tolist() == [2, 0, 0]


def test_a_turbine_out_of_range_goes_to_the_nearest_that_has_it_in_range(three_stations):
    assigned = np.array([0, 0, 0])
    Z = ranges((1, 1, 0), (1, 1, 1), (1, 1, 1))
    assert reassign(three_stations, assigned, Z).tolist() == [0, 0, 2]
    without_the_nearest = ranges((1, 1, 0), (1, 1, 1), (1, 1, 0))
    assert reassign(three_stations, assigned, without_the_nearest).tolist() == [0, 0, 1]


def test_a_turbine_in_no_range_goes_where_the_round_trip_is_shortest(three_stations):
    Z = np.zeros((3, 3), dtype=bool)
    assert reassign(three_stations, np.array([2, 2, 0]), Z).tolist() == [0, 1, 2]


def test_a_station_that_may_not_serve_a_turbine_does_not_get_it(three_stations):
    allowed = ranges((1, 1, 1), (1, 1, 1), (1, 1, 0))
    Z = np.zeros((3, 3), dtype=bool)
    instance = replace(three_stations, allowed=allowed)
    assert reassign(instance, np.array([0, 0, 0]), Z).tolist() == [0, 1, 1]


def test_the_assignment_given_is_left_as_it_was(three_stations):
    assigned = np.array([2, 2, 0])
    reassign(three_stations, assigned, np.zeros((3, 3), dtype=bool))
    assert assigned.tolist() == [2, 2, 0]


def test_a_turbine_that_nobody_reaches_is_named(under_wind):
    instance = under_wind([(0.0, 0.0)], [(100.0, 0.0), (90_000.0, 0.0)])
    with pytest.raises(InvalidInput, match=r"within reach of a station, got turbines \[1\]"):
        reassign(instance, np.array([0, 0]), np.ones((1, 2), dtype=bool))
