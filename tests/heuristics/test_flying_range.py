"""The two circles of the flying range, on cases done by hand."""

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.heuristics.flying_range import flying_range

EAST_WIND = (-10.0, 0.0)  # Moves the circle 10.8 km westward in 18 min.


def on_axis(under_wind, *x, w=EAST_WIND):
    """One station at the origin and turbines along the x axis [km]."""
    return under_wind([(0.0, 0.0)], [(1000.0 * position, 0.0) for position in x], w)


def test_the_range_ends_upwind_where_the_moved_circle_does(under_wind):
    instance = on_axis(under_wind, 2.1, 2.3, -12.9, -13.1)
    assert flying_range(instance, 13_000.0).tolist() == [[True, False, True, False]]


def test_a_radius_below_the_shift_leaves_out_the_station_itself(under_wind):
    instance = on_axis(under_wind, 0.0, -2.0, -2.3, -8.5, -8.7)
    assert flying_range(instance, 8_640.0).tolist() == [[False, False, True, True, False]]


def test_two_circles_that_do_not_meet_leave_nothing(under_wind):
    assert not flying_range(on_axis(under_wind, 0.0, -5.4, -10.8), 5_000.0).any()


def test_without_wind_the_range_is_the_circle(under_wind):
    instance = on_axis(under_wind, 0.9, 1.1, -0.9, -1.1, w=(0.0, 0.0))
    assert flying_range(instance, 1_000.0).tolist() == [[True, False, True, False]]


def test_reversed_wind_mirrors_the_range(under_wind):
    x = np.linspace(-15.0, 15.0, 31)
    east = flying_range(on_axis(under_wind, *x), 13_500.0)
    west = flying_range(on_axis(under_wind, *x, w=(10.0, 0.0)), 13_500.0)
    assert np.array_equal(east[:, ::-1], west)


def test_each_station_has_its_own_radius(under_wind):
    instance = under_wind([(0.0, 0.0), (0.0, 0.0)], [(500.0, 0.0)])
    assert flying_range(instance, [400.0, 600.0]).tolist() == [[False], [True]]


@pytest.mark.parametrize("speed", [0.0, 5.0, 10.0, 15.0])
def test_by_default_every_turbine_that_allows_a_return_is_in_range(under_wind, speed):
    angle = np.radians(np.arange(0.0, 360.0, 7.0))
    for distance in np.linspace(100.0, 9000.0, 20):
        ring = distance * np.column_stack([np.cos(angle), np.sin(angle)])
        instance = under_wind([(0.0, 0.0)], ring, (speed, 0.0))
        assert (flying_range(instance) | ~instance.reachable).all()


def test_half_a_flight_against_the_wind_ends_the_range_of_the_radius_named_for_it(under_wind):
    reach = (16.0 - 10.0) * 540.0
    instance = on_axis(under_wind, 0.99e-3 * reach, 1.01e-3 * reach)
    assert flying_range(instance, (16.0 + 10.0) * 540.0).tolist() == [[True, False]]


@pytest.mark.parametrize("radius", [[400.0, 500.0], [[400.0]]])
def test_radii_for_other_stations_are_refused(under_wind, radius):
    with pytest.raises(InvalidInput, match="to be one radius or 1"):
        flying_range(on_axis(under_wind, 1.0), radius)


@pytest.mark.parametrize("radius", [-1.0, float("nan")])
def test_a_negative_or_missing_radius_is_refused(under_wind, radius):
    with pytest.raises(InvalidInput, match="flying range >= 0 m"):
        flying_range(on_axis(under_wind, 1.0), radius)
