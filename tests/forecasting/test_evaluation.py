"""Backtests: errors counted by hand, on the circle, beside persistence."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.conformal_persistence import ConformalPersistence
from windopt.forecasting.evaluation import backtest, evaluate
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.targets import wrapped


def ramp(n=100, speed=0.1, turn=2.0):
    """Wind that gains ``speed`` [m/s] and turns by ``turn`` [deg] every five minutes."""
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(5, "m") * np.arange(n)
    return WindSeries(time, speed * np.arange(n), np.radians(turn * np.arange(n) % 360))


def test_persistence_is_wrong_by_what_the_wind_changed():
    score = backtest([], ramp()).scores[0]
    ahead = np.arange(1, 9)
    assert score.speed_mae == pytest.approx(0.1 * ahead)
    assert score.speed_rmse == pytest.approx(0.1 * ahead)
    assert np.degrees(score.direction_mae) == pytest.approx(2.0 * ahead)


def test_north_has_no_seam():
    assert wrapped(np.radians(1.0 - 359.0)) == pytest.approx(np.radians(2.0))
    assert wrapped(np.radians(359.0 - 1.0)) == pytest.approx(np.radians(-2.0))


def test_persistence_stands_first_and_once():
    table = backtest([LinearAutoregression().fit(ramp(400)), Persistence()], ramp())
    assert [score.name for score in table.scores] == ["persistence", "linear autoregression"]
    assert table.windows == 100 - 32 + 1


def test_a_linear_law_gives_all_the_skill_there_is():
    table = backtest([LinearAutoregression().fit(ramp(400, turn=0))], ramp(turn=0))
    speed, _ = table["linear autoregression"].skill(table["persistence"])
    assert speed == pytest.approx(1.0, abs=1e-2)


def test_windows_in_many_blocks_are_scored_as_in_one():
    long = backtest([], ramp(25_000, speed=1e-3)).scores[0]
    assert long.speed_mae == pytest.approx(1e-3 * np.arange(1, 9))


def test_baselines_without_enough_to_learn_from_are_left_out_and_named():
    table = evaluate([], ramp(180), test=1 / 3)
    names = [score.name for score in table.scores]
    assert names == ["persistence", "conformal persistence"]
    assert any("Without linear autoregression" in note for note in table.notes)


def test_forecasters_with_different_horizons_are_not_compared():
    short = Persistence(horizon=np.timedelta64(20, "m"))
    with pytest.raises(InvalidInput, match="one horizon"):
        backtest([Persistence(), short], ramp())


def test_each_forecaster_sees_as_much_history_as_it_looks_back():
    short = LinearAutoregression(history=np.timedelta64(30, "m")).fit(ramp(400))
    long = ConformalPersistence(history=np.timedelta64(3, "h")).fit(ramp(400))
    table = backtest([short, long], ramp())
    assert table.windows == 100 - 36 - 8 + 1
    assert table["linear autoregression"].speed_mae == pytest.approx(np.zeros(8), abs=1e-3)
