"""Flights written as arcs and read back are the same flights."""

import numpy as np
import pytest

from formulations.flights import arcs_of, flights
from formulations.route_indexed import route_indexed
from formulations.time_flow import time_flow

T = np.ones((2, 6, 6))
ROUTES = [(0, (3, 1)), (0, (4,)), (1, (0, 2))]


def test_the_arcs_of_a_flight_are_that_flight():
    assert flights(arcs_of((2, 0, 1), 4)) == [(2, 0, 1)]


def test_a_plan_is_a_point_of_time_flow():
    program = time_flow(T, 100.0)
    assert sorted(program.routes(program.point(ROUTES))) == ROUTES


def test_a_plan_is_a_point_of_route_indexed_in_the_order_of_its_symmetry_breaking():
    program = route_indexed(T, 100.0, routes=2)
    x = program.point(ROUTES)
    assert sorted(program.routes(x)) == ROUTES
    assert not x[~program.flown].any()


def test_more_flights_than_routes_are_no_point():
    with pytest.raises(ValueError, match="no more routes"):
        route_indexed(T, 100.0, routes=1).point(ROUTES)
