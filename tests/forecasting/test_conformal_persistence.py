"""Bands of constant width around persistence."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.conformal_persistence import ConformalPersistence
from windopt.forecasting.evaluation import backtest


def walk(n=5000, seed=0):
    rng = np.random.default_rng(seed)
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(5, "m") * np.arange(n)
    speed = 100 + np.cumsum(rng.normal(0, 0.3, n))
    return WindSeries(time, speed, np.cumsum(rng.normal(0, 0.02, n)) % (2 * np.pi))


def test_a_random_walk_stays_within_the_bands_as_often_as_they_say():
    fitted = ConformalPersistence().fit(walk())
    found = backtest([fitted], walk(seed=1))["conformal persistence"]
    assert found.mean("speed_in_90").mean() == pytest.approx(0.9, abs=0.04)
    assert found.mean("direction_in_50").mean() == pytest.approx(0.5, abs=0.06)


def test_bands_widen_with_the_square_root_of_time():
    fitted = ConformalPersistence().fit(walk(20_000))
    width = fitted.speed[:, 4] - fitted.speed[:, 0]
    assert width == pytest.approx(width[0] * np.sqrt(np.arange(1, 9)), rel=0.1)


def test_the_forecast_itself_is_persistence():
    wind = walk()
    assert ConformalPersistence().fit(wind).predict(wind).speed == pytest.approx(
        np.full(8, wind.speed[-1])
    )


def test_an_unfitted_one_says_so():
    with pytest.raises(InvalidInput, match="fitted first"):
        ConformalPersistence().predict(walk())
