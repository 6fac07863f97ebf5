"""Issuing a forecast from rows as they come off a mast: steps, gaps and what is said about them."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.forecaster import without_short_gaps
from windopt.forecasting.persistence import Persistence

NAN = float("nan")


def series(speed, step=5):
    speed = np.asarray(speed, dtype=float)
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(step, "m") * np.arange(len(speed))
    direction = 350.0 + np.arange(len(speed))[::-1] % 2  # 350 in the last row
    return WindSeries(time, speed, np.radians(direction))


def test_persistence_repeats_the_last_wind():
    forecast = Persistence().predict(series(np.arange(30.0)))
    assert forecast.speed == pytest.approx(np.full(8, 29.0))
    assert forecast.theta_met == pytest.approx(np.full(8, np.radians(350.0)))
    assert forecast.method == "persistence"
    assert forecast.notes == ()


def test_the_forecast_begins_one_step_after_the_last_row_and_lasts_the_horizon():
    known = series(np.ones(12), step=10)
    forecast = Persistence().predict(known)
    assert forecast.issued == known.time[-1]
    assert forecast.time[0] - forecast.issued == np.timedelta64(10, "m")
    assert forecast.time[-1] - forecast.issued == np.timedelta64(40, "m")


def test_a_short_gap_is_filled_and_mentioned():
    speed = np.arange(30.0)
    speed[[27, 28, 29]] = NAN
    forecast = Persistence().predict(series(speed))
    assert forecast.speed == pytest.approx(np.full(8, 26.0))
    assert forecast.notes == ("3 missing rows of the history repeat the row before them.",)


def test_a_long_gap_is_refused_with_the_time_at_which_it_began():
    speed = np.ones(30)
    speed[20:25] = NAN
    with pytest.raises(InvalidInput, match="2020-01-01T01:40"):
        Persistence().predict(series(speed))


def test_a_vane_that_is_stuck_makes_the_forecast_say_so():
    stuck = series(np.arange(60.0))
    stuck.theta_met[:30] = np.linspace(0, 1, 30)
    stuck.theta_met[30:] = 1.0
    (warning,) = Persistence().predict(stuck).notes
    assert warning == (
        "24 of the last 24 rows look faulty: a direction that rests for hours in wind."
    )
    assert Persistence().predict(stuck.part(slice(0, 30))).notes == ()


def test_a_gap_before_the_history_does_not_matter():
    speed = np.ones(60)
    speed[:30] = NAN
    assert Persistence().predict(series(speed)).notes == ()


def test_a_gap_that_nothing_precedes_is_refused():
    speed = np.ones(24)
    speed[0] = NAN
    with pytest.raises(InvalidInput, match="2020-01-01T00:00"):
        Persistence().predict(series(speed))


def test_filling_changes_only_what_was_missing():
    speed = np.arange(30.0)
    speed[25] = NAN
    filled = without_short_gaps(series(speed), 24)
    assert np.flatnonzero(filled.speed != np.arange(30.0)).tolist() == [25]


@pytest.mark.parametrize("n", [2, 23])
def test_too_short_a_history_is_refused(n):
    with pytest.raises(InvalidInput, match="at least 24 rows"):
        Persistence().predict(series(np.ones(n)))


def test_a_history_without_a_single_valid_row_is_refused():
    with pytest.raises(InvalidInput, match="gaps"):
        Persistence().predict(series(np.full(30, NAN)))


def test_a_step_that_does_not_divide_the_horizon_is_refused():
    with pytest.raises(InvalidInput, match="horizon"):
        Persistence().predict(series(np.ones(30), step=15))
