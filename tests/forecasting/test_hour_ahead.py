"""Forecasts of hourly means, asked about the next 40 minutes."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.evaluation import backtest
from windopt.forecasting.hour_ahead import HOUR, HourAhead
from windopt.forecasting.persistence import Persistence

HOURLY = Persistence(history=2 * HOUR, horizon=HOUR)


def ramp(n=600, step=5):
    """Return a wind that gains 0.6 m/s an hour and turns through north by 12 degrees an hour."""
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(step, "m") * np.arange(n)
    minute = step * np.arange(n)
    return WindSeries(time, 0.01 * minute, np.radians((300 + 0.2 * minute) % 360))


def test_persistence_of_the_hour_repeats_its_mean():
    wind = ramp()
    forecast = HourAhead(HOURLY).predict(wind)
    assert forecast.speed == pytest.approx(np.full(8, wind.speed[-12:].mean()))


def test_on_a_ramp_the_hour_lags_half_an_hour_behind_the_last_step():
    table = backtest([HourAhead(HOURLY)], ramp())
    hour, last = (score.speed_mae for score in reversed(table.scores))
    assert hour - last == pytest.approx(np.full(8, 0.01 * 27.5))


def test_a_forecaster_of_hours_is_fitted_to_hours():
    fitted = HourAhead(LinearAutoregression(2 * HOUR, HOUR)).fit(ramp(3000))
    forecast = fitted.predict(ramp(3000).part(slice(0, 600)))
    assert forecast.speed == pytest.approx(np.full(8, 0.01 * (5 * 600 + 27.5)), rel=0.01)
