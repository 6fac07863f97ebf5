"""The whole way: a measured series in, a checked forecast, set-points and flights out."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

import windopt
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.turbine import Turbine
from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.persistence import Persistence
from windopt.heuristics.algorithm_1 import face_or_hold
from windopt.planning import yaw
from windopt.planning.plan import FORECASTERS, plan
from windopt.planning.routing_methods import METHODS
from windopt.result import Status

FARM = Farm("row", tuple(Turbine(f"T{i}", 600.0 * i, 0.0) for i in range(5)))
FLEET = Fleet((Station("S1", 1200.0, 300.0),))


def series(days=4, minutes=5, seed=0):
    rng = np.random.default_rng(seed)
    time = np.datetime64("2020-03-01T00:00") + np.arange(0, days * 1440, minutes).astype("m8[m]")
    wander = np.cumsum(rng.normal(0, 0.1, (2, len(time))), axis=1)
    speed = np.clip(9.0 + 0.3 * wander[0], 4.0, 13.0)
    return WindSeries(time, speed, (0.1 * wander[1]) % (2 * pi))


@pytest.mark.parametrize("forecaster", FORECASTERS)
@pytest.mark.parametrize(("minutes", "steps"), [(5, 8), (10, 4)])
def test_forty_minutes_are_planned_and_pass_the_check(forecaster, minutes, steps):
    made = plan(FARM, FLEET, series(minutes=minutes), forecaster=forecaster)
    assert len(made.yaw) == len(made.forecast) == steps
    report = windopt.check(made)
    assert report.passed, report.violations
    assert report.set_points == 5 * steps


def test_what_is_measured_later_changes_nothing():
    time = np.datetime64("2020-03-03T12:00")
    measured = series()
    later = measured.time > time
    other = replace(measured, speed=np.where(later, 0.0, measured.speed))
    one, two = (plan(FARM, FLEET, known, time=time) for known in (measured, other))
    assert one.inspection.found() == two.inspection.found()
    assert [step.found() for step in one.yaw] == [step.found() for step in two.yaw]


def test_each_step_starts_where_the_nacelles_were_left():
    # From 30 deg off the wind at 14 m/s the turbines are at rated power: nothing need turn.
    time = np.datetime64("2020-03-01") + np.arange(0, 200, 5).astype("m8[m]")
    steady = WindSeries(time, np.full(40, 14.0), np.full(40, 1.0))
    made = plan(FARM, FLEET, steady, forecaster="persistence")
    nacelles = {point.nacelle for step in made.yaw for point in step.found().set_points}
    assert np.ptp(list(nacelles)) < 1e-6


STRONG = WindSeries(
    np.datetime64("2020-03-01") + np.arange(0, 200, 5).astype("m8[m]"),
    np.full(40, 14.0),
    np.linspace(0.0, 2.0, 40),
)


@pytest.mark.parametrize("method", METHODS)
def test_no_time_still_gives_a_whole_plan_and_says_so(method):
    made = plan(FARM, FLEET, STRONG, forecaster="persistence", time_limit=0.0, method=method)
    assert windopt.check(made).passed
    assert "not proved" in made.inspection.reason.lower()


def watched(limits, *, stopped_at=0):
    """Return the paper's rule as a method that notes its time limits and may be interrupted."""

    def method(problem, *, time_limit, seed):
        limits.append(time_limit)
        found = face_or_hold(problem)
        interrupted = len(limits) == stopped_at
        return replace(found, status=Status.INTERRUPTED) if interrupted else found

    return method


def test_set_points_and_flights_share_the_time_limit(monkeypatch):
    limits = []
    monkeypatch.setitem(yaw.METHODS, "watched", watched(limits))
    options = {"forecaster": "persistence", "yaw_method": "watched"}
    plan(FARM, FLEET, STRONG, time_limit=20.0, **options)
    assert len(limits) == 8
    assert max(limits) <= 10.0
    assert limits[0] <= 10.0 / 8


def test_ctrl_c_ends_the_whole_plan(monkeypatch):
    limits = []
    monkeypatch.setitem(yaw.METHODS, "watched", watched(limits, stopped_at=2))
    made = plan(FARM, FLEET, STRONG, forecaster="persistence", yaw_method="watched")
    assert limits[1] > 0.0
    assert limits[2:] == [0.0] * 6
    assert "not proved" in made.inspection.reason.lower()
    assert windopt.check(made).passed


def test_thinner_air_delivers_less():
    thin, thick = (plan(FARM, FLEET, series(), air_density=rho).yaw[0] for rho in (1.0, 1.2))
    assert thin.objective < thick.objective


def test_a_forecaster_of_ones_own_is_taken_as_it_is():
    made = plan(FARM, FLEET, series(), forecaster=Persistence())
    assert made.forecast.method == "persistence"


def test_flights_are_planned_for_the_mean_wind_of_the_forecast():
    made = plan(FARM, FLEET, series())
    assert made.inspection.found().wind == made.forecast.mean


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"forecaster": "crystal ball"}, "forecaster"),
        ({"time": np.datetime64("1999-01-01")}, "time"),
        ({"yaw_method": "magic"}, "method"),
        ({"method": "magic"}, "method"),
        ({"time_limit": -1.0}, "time_limit"),
        ({"time_limit": np.nan}, "time_limit"),
        ({"air_density": 0.0}, "air_density"),
    ],
)
def test_bad_options_are_named(options, field):
    with pytest.raises(InvalidInput, match=f"Expected {field} "):
        plan(FARM, FLEET, series(), **options)


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"method": "magic"}, "method"),
        ({"rule": "none"}, "rule"),
        ({"gap": 2.0}, "gap"),
        ({"memory": np.nan}, "memory"),
        ({"dwell": -1.0}, "dwell"),
        ({"worth": -1.0}, "worth"),
        ({"worth": 9.0, "method": "baseline"}, "method"),
    ],
)
def test_what_flights_cannot_be_planned_with_is_refused_before_set_points(
    monkeypatch, options, field
):
    def schedule(*_, **__):
        raise AssertionError("set-points planned although flights cannot be")

    monkeypatch.setattr("windopt.planning.plan.plan_schedule", schedule)
    with pytest.raises(InvalidInput, match=f"Expected {field} "):
        plan(FARM, FLEET, series(), **options)


def test_a_series_too_short_to_forecast_from_is_refused():
    with pytest.raises(InvalidInput):
        plan(FARM, FLEET, series().part(slice(0, 3)))
