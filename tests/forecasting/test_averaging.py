"""Means of a series over longer steps."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.averaging import averaged

HOUR = np.timedelta64(1, "h")


def ramp(n=600, step=5):
    """Return a wind that gains 0.6 m/s an hour and turns through north by 12 degrees an hour."""
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(step, "m") * np.arange(n)
    minute = step * np.arange(n)
    return WindSeries(time, 0.01 * minute, np.radians((300 + 0.2 * minute) % 360))


@pytest.mark.parametrize("step", [5, 10])
def test_an_hour_has_the_mean_of_its_steps(step):
    hourly = averaged(ramp(step=step), HOUR)
    rows = 60 // step
    assert hourly.step == HOUR
    assert hourly.speed[3] == pytest.approx(ramp(step=step).speed[3 * rows : 4 * rows].mean())


def test_the_last_mean_ends_with_the_last_row_and_bears_its_time():
    wind = ramp(605)
    hourly = averaged(wind, HOUR)
    assert len(hourly) == 50
    assert hourly.time[-1] == wind.time[-1]
    assert hourly.speed[-1] == pytest.approx(wind.speed[-12:].mean())
    assert hourly.notes == ("Means over 60 minutes were taken of rows every 5 minutes.",)


def test_a_mean_direction_knows_no_seam():
    wind = ramp(24)
    wind.theta_met[:] = np.radians(np.where(np.arange(24) % 2, 350, 10))
    wind.speed[:] = 5.0
    assert np.cos(averaged(wind, HOUR).theta_met) == pytest.approx([1.0, 1.0])


def test_a_mean_takes_half_of_its_rows_at_least():
    wind = ramp()
    wind.speed[12:18] = np.nan
    wind.speed[24:31] = np.nan
    hourly = averaged(wind, HOUR)
    assert np.flatnonzero(~hourly.valid).tolist() == [2]
    assert hourly.speed[1] == pytest.approx(wind.speed[18:24].mean())


def test_a_calm_keeps_its_last_direction():
    wind = ramp(24)
    wind.speed[:] = 0.0
    assert averaged(wind, HOUR).theta_met == pytest.approx(wind.theta_met[11::12])


def test_a_series_in_the_step_asked_for_is_left_alone():
    wind = ramp()
    assert averaged(wind, wind.step) is wind


def test_a_step_that_does_not_divide_is_refused():
    with pytest.raises(InvalidInput, match="multiple"):
        averaged(ramp(step=7), HOUR)
