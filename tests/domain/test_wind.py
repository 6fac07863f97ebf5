"""Winds against the compass, and series against their own promises."""

from math import nan, pi, radians

import numpy as np
import pytest

from windopt.domain.wind import Wind, WindForecast, WindSeries
from windopt.errors import InvalidInput

TIME = np.arange("2020-01-01T00:00", "2020-01-01T01:00", 10, dtype="datetime64[m]")


@pytest.mark.parametrize(
    ("direction", "u", "v"), [(0, 0, -10), (90, -10, 0), (180, 0, 10), (270, 10, 0), (450, -10, 0)]
)
def test_a_wind_blows_from_its_meteorological_direction(direction, u, v):
    wind = Wind.from_met(10.0, direction)
    assert (wind.u, wind.v) == pytest.approx((u, v), abs=1e-12)
    assert wind.speed == pytest.approx(10.0)


@pytest.mark.parametrize("degrees", range(0, 360, 15))
def test_the_papers_two_angles_are_one_wind(degrees):
    wind = Wind.from_met(5.0, degrees)
    assert wind.theta_met == pytest.approx(radians(degrees), abs=1e-12) or degrees == 0
    assert (wind.theta_pol + wind.theta_met) % (2 * pi) == pytest.approx(1.5 * pi)
    assert 0 <= wind.theta_pol < 2 * pi
    assert 0 <= wind.theta_met < 2 * pi


@pytest.mark.parametrize(("speed", "direction"), [(-1, 0), (nan, 0), (1, nan), (float("inf"), 0)])
def test_no_wind_is_made_of_what_is_not_a_number(speed, direction):
    with pytest.raises(InvalidInput, match="wind"):
        Wind.from_met(speed, direction)


def series(**changes):
    given = {"time": TIME, "speed": np.full(6, 8.0), "theta_met": np.full(6, pi)}
    return WindSeries(**(given | changes))


def test_a_series_knows_only_the_past():
    known = series().until(np.datetime64("2020-01-01T00:25"))
    assert known.time[-1] == np.datetime64("2020-01-01T00:20")


def test_a_series_answers_for_no_time_outside_it():
    with pytest.raises(InvalidInput, match="between 2020-01-01T00:00"):
        series().until(np.datetime64("2021-01-01"))


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"speed": np.full(5, 8.0)}, "equally long"),
        ({"speed": np.full(6, -1.0)}, "speed"),
        ({"theta_met": np.full(6, np.inf)}, "finite"),
        ({"time": TIME[::-1]}, "time"),
        ({"time": TIME[[0, 1, 2, 3, 4, 4]]}, "time"),
    ],
)
def test_a_series_that_cannot_be_is_refused(changes, field):
    with pytest.raises(InvalidInput, match=field):
        series(**changes)


def test_missing_values_are_marked_not_refused():
    speed = np.array([8.0, nan, 8.0, 8.0, 8.0, 8.0])
    assert series(speed=speed).valid.tolist() == [True, False, True, True, True, True]


def test_the_mean_of_a_forecast_moves_the_air_as_far():
    theta_met = np.radians([350.0, 10.0])
    forecast = WindForecast(TIME[0], TIME[1:3], np.full(2, 10.0), theta_met, "test")
    mean = forecast.mean
    assert mean.theta_met == pytest.approx(0, abs=1e-9) or mean.theta_met == pytest.approx(2 * pi)
    assert mean.speed == pytest.approx(10.0 * np.cos(radians(10.0)))
