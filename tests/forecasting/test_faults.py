"""Faults: what is planted is found, and what the wind can do is left alone."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.faults import find_faults, without_faults
from windopt.forecasting.windows import windows


def series(n=600, step=5, seed=0):
    """Return a breeze that never holds still."""
    rng = np.random.default_rng(seed)
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(step, "m") * np.arange(n)
    speed = 8 + rng.normal(0, 0.5, n)
    return WindSeries(time, speed, np.radians(200 + rng.normal(0, 5, n)))


def test_a_healthy_mast_is_left_alone():
    assert not find_faults(series()).any.any()
    assert without_faults(series()).notes == ()


@pytest.mark.parametrize("step", [5, 10])
def test_a_stuck_vane_is_masked_from_its_first_row_to_its_last(step):
    wind = series(step=step)
    wind.theta_met[100:200] = wind.theta_met[100]
    assert np.flatnonzero(find_faults(wind).stuck).tolist() == [*range(100, 200)]
    masked = without_faults(wind)
    assert masked.valid.sum() == 500
    assert masked.notes == ("100 rows masked: a direction that rests for hours in wind.",)


def test_a_vane_may_rest_for_an_hour():
    wind = series()
    wind.theta_met[100:112] = wind.theta_met[100]
    assert not find_faults(wind).any.any()


def test_a_vane_may_rest_in_a_calm():
    wind = series()
    wind.theta_met[100:200] = wind.theta_met[100]
    wind.speed[100:200] = 0.3 + 0.001 * np.arange(100)
    assert not find_faults(wind).any.any()


def test_rows_that_a_logger_repeated_are_masked():
    wind = series()
    wind.theta_met[100:110] = wind.theta_met[100]
    wind.speed[100:110] = wind.speed[100]
    assert np.flatnonzero(find_faults(wind).repeated).tolist() == [*range(100, 110)]


def test_a_spike_is_masked_and_a_gust_front_is_not():
    wind = series()
    wind.speed[50] = 80.0
    wind.speed[150] = 30.0
    wind.speed[300:] += 15.0
    assert np.flatnonzero(find_faults(wind).spikes).tolist() == [50, 150]


def test_spikes_at_either_end_are_found():
    wind = series()
    wind.speed[[0, -1]] = 60.0
    assert np.flatnonzero(find_faults(wind).spikes).tolist() == [0, 599]


def test_directions_in_steps_of_ten_degrees_may_rest_for_hours():
    wind = series()
    steps = np.radians(10.0)
    wind.theta_met[:] = np.radians(200 + 40 * np.sin(np.arange(600) / 60))
    wind.theta_met[:] = np.round(wind.theta_met / steps) * steps
    assert not find_faults(wind).any.any()


def test_a_direction_that_never_changed_leaves_no_window_and_says_so():
    wind = series()
    wind.theta_met[:] = 1.0
    masked = without_faults(wind)
    assert "600 rows masked" in masked.notes[0]
    with pytest.raises(InvalidInput, match="direction that rests for hours"):
        windows(masked)


def test_missing_rows_are_no_faults():
    wind = series()
    wind.speed[100:300] = np.nan
    wind.theta_met[100:300] = np.nan
    assert not find_faults(wind).any.any()
