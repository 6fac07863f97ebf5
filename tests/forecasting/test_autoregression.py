"""Linear autoregression against series whose law is known."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.windows import Traces, windows

FIVE = np.timedelta64(5, "m")


def series(velocity):
    u, v = np.moveaxis(np.asarray(velocity, dtype=float), -1, 0)
    time = np.datetime64("2020-01-01T00:00") + FIVE * np.arange(len(u))
    return WindSeries(time, np.hypot(u, v), np.arctan2(-u, -v) % (2 * np.pi))


def rotating(n=600, period=150):
    """Return 10 m/s that turn steadily: linear in their own velocity, and never still."""
    angle = 2 * np.pi * np.arange(n) / period
    return series(10 * np.stack([np.cos(angle), np.sin(angle)], axis=-1))


def meandering(n=2000, seed=0):
    """Return a first-order autoregressive wind around (8, 2) m/s."""
    rng = np.random.default_rng(seed)
    velocity = np.zeros((n, 2))
    for i in range(1, n):
        velocity[i] = 0.9 * velocity[i - 1] + rng.normal(0, 0.4, 2)
    return series(velocity + np.array([8.0, 2.0]))


def test_a_steadily_turning_wind_is_forecast_exactly():
    wind = rotating()
    forecast = LinearAutoregression().fit(wind).predict(wind.part(slice(0, 100)))
    assert forecast.velocity == pytest.approx(wind.velocity[100:108], abs=1e-3)
    assert forecast.speed == pytest.approx(np.full(8, 10.0), abs=1e-3)


def test_a_meandering_wind_returns_to_its_mean_as_its_law_says():
    wind = meandering(20_000)
    fitted = LinearAutoregression().fit(wind)
    test = windows(meandering(2000, seed=1))
    best = [8.0, 2.0] + 0.9**8 * (test.past.velocity[:, -1] - [8.0, 2.0])
    ahead = fitted.forecast(test.past, FIVE).velocity[:, -1]
    assert np.abs(ahead - best).mean() < 0.12  # the law's own error is 0.6 m/s


def test_a_gap_costs_windows_and_nothing_else():
    wind = rotating()
    wind.speed[300:310] = np.nan
    forecast = LinearAutoregression().fit(wind).predict(wind.part(slice(0, 100)))
    assert forecast.velocity == pytest.approx(rotating().velocity[100:108], abs=1e-3)


def test_a_wind_that_never_changes_is_forecast_not_to():
    wind = series(np.tile([3.0, 4.0], (300, 1)))
    forecast = LinearAutoregression().fit(wind).predict(wind)
    assert forecast.velocity == pytest.approx(np.tile([3.0, 4.0], (8, 1)), abs=1e-6)


def test_a_calm_is_forecast_to_last():
    forecast = LinearAutoregression().fit(calm := series(np.zeros((300, 2)))).predict(calm)
    assert forecast.speed == pytest.approx(np.zeros(8))


def test_turning_the_compass_turns_the_forecast():
    # The ridge shrinks along the axes of the compass, so a trace of them remains.
    wind, turned = meandering(), meandering()
    turned.theta_met[:] = (turned.theta_met + 1.0) % (2 * np.pi)
    straight = LinearAutoregression().fit(wind).predict(wind)
    rotated = LinearAutoregression().fit(turned).predict(turned)
    assert rotated.speed == pytest.approx(straight.speed, abs=1e-2)
    assert np.cos(rotated.theta_met - straight.theta_met) == pytest.approx(np.cos(1.0), abs=1e-3)


def test_an_unfitted_forecaster_says_so():
    with pytest.raises(InvalidInput, match="fitted first"):
        LinearAutoregression().predict(rotating())


def test_a_series_of_another_step_is_refused():
    fitted = LinearAutoregression().fit(rotating())
    past = Traces(np.ones((1, 12)), np.ones((1, 12)))
    with pytest.raises(InvalidInput, match="step"):
        fitted.forecast(past, np.timedelta64(10, "m"))


def test_three_rows_or_none_valid_are_refused():
    with pytest.raises(InvalidInput, match="at least 32 rows"):
        LinearAutoregression().fit(rotating(3))
    empty = rotating()
    empty.speed[:] = np.nan
    with pytest.raises(InvalidInput, match="valid rows"):
        LinearAutoregression().fit(empty)


def test_fewer_windows_than_coefficients_are_refused():
    with pytest.raises(InvalidInput, match="146 windows"):
        LinearAutoregression().fit(rotating(150))
