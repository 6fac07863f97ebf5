"""Quantiles of a forecast, and the paths drawn from them."""

import numpy as np
import pytest

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import WindForecast
from windopt.errors import InvalidInput

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
STANDARD = np.array([-1.645, -0.674, 0.0, 0.674, 1.645])


def quantiles(H=8, memory=(0.5, 0.5)):
    """Return Gaussian quantiles that widen with the square root of the step."""
    width = np.sqrt(np.arange(1, H + 1))[:, None]
    return Quantiles(LEVELS, 20 + width * STANDARD, 0.1 * width * STANDARD, memory)


def forecast(**kwargs):
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(5, "m") * np.arange(9)
    return WindForecast(time[0], time[1:], np.full(8, 20.0), np.full(8, 0.1), "test", **kwargs)


def test_paths_keep_the_quantiles_they_are_drawn_from():
    speed, turn = quantiles().paths(40_000, np.random.default_rng(0))
    for level, z in zip(LEVELS, STANDARD, strict=True):
        width = np.sqrt(np.arange(1, 9))
        assert np.quantile(speed, level, axis=0) == pytest.approx(20 + z * width, abs=0.08)
        assert np.quantile(turn, level, axis=0) == pytest.approx(0.1 * z * width, abs=0.008)


def test_brownian_paths_have_independent_increments():
    speed, _ = quantiles().paths(20_000, np.random.default_rng(0))
    steps = np.diff(speed, axis=1)
    correlation = np.corrcoef(steps, rowvar=False)
    assert np.abs(correlation - np.eye(7)).max() < 0.05
    assert steps.std(axis=0) == pytest.approx(np.ones(7), abs=0.05)


def test_a_longer_memory_makes_smoother_paths():
    rough, smooth = (
        quantiles(memory=(a, a)).paths(4000, np.random.default_rng(0))[0] for a in (0.5, 0.1)
    )
    assert np.diff(smooth).std() < 0.7 * np.diff(rough).std()


def test_speeds_never_fall_below_a_calm():
    low = Quantiles(LEVELS, np.maximum(1 + STANDARD * np.ones((8, 1)), 0), np.zeros((8, 5)))
    assert low.paths(1000, np.random.default_rng(0))[0].min() >= 0


def test_scenarios_are_forecasts_around_the_forecast():
    drawn = forecast(quantiles=quantiles()).scenarios(500, np.random.default_rng(0))
    assert len(drawn) == 500
    assert all(one.theta_met.min() >= 0 and one.theta_met.max() < 2 * np.pi for one in drawn)
    mean = np.mean([one.velocity for one in drawn], axis=0)
    assert mean[0] == pytest.approx(forecast().velocity[0], abs=0.5)


def test_the_same_seed_draws_the_same_scenarios():
    one, two = (
        forecast(quantiles=quantiles()).scenarios(3, np.random.default_rng(7)) for _ in range(2)
    )
    assert all((a.speed == b.speed).all() for a, b in zip(one, two, strict=True))


def test_a_forecast_without_quantiles_has_no_scenarios():
    with pytest.raises(InvalidInput, match="quantiles"):
        forecast().scenarios(3, np.random.default_rng(0))


def test_quantiles_that_cross_or_do_not_match_are_refused():
    speed = 20 + np.ones((8, 1)) * STANDARD
    with pytest.raises(InvalidInput, match="speed"):
        Quantiles(LEVELS, speed[:, ::-1], speed)
    with pytest.raises(InvalidInput, match="turn"):
        Quantiles(LEVELS, speed, speed[:, :4])
    with pytest.raises(InvalidInput, match="levels"):
        Quantiles((0.5, 0.5), speed[:, :2], speed[:, :2])
