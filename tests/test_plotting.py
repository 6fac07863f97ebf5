"""Pictures: the Axes that goes in comes out, with its units on the labels."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from windopt import plotting
from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind, WindSeries
from windopt.errors import InvalidInput
from windopt.io.built_in import built_in_farm, built_in_stations
from windopt.planning.inspection import plan_inspection
from windopt.planning.plan import plan
from windopt.planning.turbine_yaw import plan_turbine_yaw
from windopt.planning.yaw import plan_yaw

WIND = Wind.from_met(8.0, 225.0)


@pytest.fixture
def ax():
    return Figure().add_subplot()


def test_a_farm_is_drawn_in_kilometres(ax):
    farm = built_in_farm()
    assert plotting.plot_farm(farm, ax) is ax
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("easting (km)", "northing (km)")
    assert ax.lines[0].get_xydata() == pytest.approx(farm.xy / 1000)


def test_every_flight_is_a_closed_line(ax):
    flights = plan_inspection(built_in_farm(), built_in_stations(), WIND).found()
    assert plotting.plot_flights(flights, ax) is ax
    lines = [line.get_xydata() for line in ax.lines if line.get_linestyle() == "-"]
    assert len(lines) == len(flights.flights)
    assert all((line[0] == line[-1]).all() for line in lines)


STEERED = plan_yaw(
    Farm("Row", tuple(Turbine(f"T{i}", 800.0 * i, 0.0) for i in range(3))),
    Wind.from_met(8.0, 272.0),
    steering=Steering(direction_std=0.05),
).found()


@pytest.mark.parametrize("draw", [plotting.plot_wakes, plotting.plot_facing_wakes])
def test_wakes_are_drawn_as_wind_speeds_between_rotors(ax, draw):
    assert draw(STEERED, ax) is ax
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("easting (km)", "northing (km)")
    speeds = ax.collections[0].get_array()
    assert 0.0 <= speeds.min() < 6.0
    assert speeds.max() == pytest.approx(8.0, abs=0.01)
    assert len(ax.lines) == 3


def test_without_wakes_there_is_nothing_to_draw(ax):
    alone = plan_turbine_yaw(STEERED.farm, WIND).found()
    with pytest.raises(InvalidInput, match="to be made under wakes"):
        plotting.plot_wakes(alone, ax)


def test_rotors_are_drawn_across_the_nacelles(ax):
    yaw = plan_turbine_yaw(built_in_farm(), WIND).found()
    assert plotting.plot_yaw(yaw, ax) is ax
    rotors = ax.collections[0]
    across = np.stack([rotors.U, rotors.V], axis=1)
    blowing = WIND.velocity / WIND.speed
    assert across @ blowing == pytest.approx(np.zeros(len(across)), abs=1e-6)


def test_the_arrow_of_the_wind_points_where_it_blows_to(ax):
    plotting.plot_wind(Wind.from_met(5.0, 270.0), ax)
    (arrow,) = ax.collections
    assert (arrow.U[0], arrow.V[0]) == pytest.approx((1.0, 0.0), abs=1e-12)
    assert ax.texts[0].get_text() == "5.0 m/s from 270°"


def test_a_forecast_follows_what_was_measured(ax):
    time = np.datetime64("2020-01-01T00:00") + np.arange(0, 1440, 5).astype("m8[m]")
    series = WindSeries(time, np.full(288, 8.0), np.full(288, 1.0))
    made = plan(built_in_farm(), built_in_stations(), series, forecaster="persistence")
    assert plotting.plot_forecast(series, made.forecast, ax) is ax
    measured, forecast = ax.lines
    assert measured.get_xdata()[-1] < forecast.get_xdata()[0]
    assert ax.get_ylabel() == "wind speed (m/s)"
