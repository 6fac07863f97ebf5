"""Scores counted by hand, and the report made of them."""

import json

import numpy as np
import pytest

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import WindSeries
from windopt.forecasting.evaluation import backtest, evaluate
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.report import report
from windopt.forecasting.scores import errors
from windopt.forecasting.windows import Traces

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


def one(speed, theta_met, quantiles=None):
    return Traces(np.array([[speed]]), np.radians([[theta_met]]), quantiles)


def breeze(n=2000, seed=0):
    """Return speeds around 6 m/s, returning to their mean, and a direction around north."""
    rng = np.random.default_rng(seed)
    speed, turn = np.zeros(n), np.zeros(n)
    for i in range(1, n):
        speed[i] = 0.9 * speed[i - 1] + rng.normal(0, 0.5)
        turn[i] = 0.9 * turn[i - 1] + rng.normal(0, 0.1)
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(5, "m") * np.arange(n)
    return WindSeries(time, np.abs(6 + speed), turn % (2 * np.pi), source="breeze")


def test_a_direction_is_scored_on_the_circle_and_as_the_paper_does_on_the_line():
    found = errors(one(5.0, 359.0), one(7.0, 1.0))
    assert found["speed"] == pytest.approx(2.0)
    assert np.degrees(found["direction"]) == pytest.approx(2.0)
    assert np.degrees(found["direction_on_line"]) == pytest.approx(358.0)


def test_a_pinball_loss_is_what_it_is_by_hand():
    quantiles = Quantiles(
        LEVELS, np.array([[[1.0, 2.0, 3.0, 4.0, 5.0]]]), np.radians([[[-4.0, -1.0, 0.0, 1.0, 4.0]]])
    )
    found = errors(one(3.0, 0.0, quantiles), one(4.5, 2.0))
    by_hand = [0.05 * 3.5, 0.25 * 2.5, 0.5 * 1.5, 0.75 * 0.5, 0.05 * 0.5]
    assert found["speed_pinball"] == pytest.approx(np.mean(by_hand))
    assert (found["speed_in_50"], found["speed_in_90"]) == (0.0, 1.0)
    turn = [0.05 * 6, 0.25 * 3, 0.5 * 2, 0.75 * 1, 0.05 * 2]
    assert np.degrees(found["direction_pinball"]) == pytest.approx(np.mean(turn))


def test_the_classes_of_speed_add_up_to_the_whole():
    score = backtest([], breeze()).scores[0]
    assert score.windows.sum() == 2000 - 31
    classes = [score.mean("speed", k) * count for k, count in enumerate(score.windows) if count]
    assert np.sum(classes, axis=0) / score.windows.sum() == pytest.approx(score.speed_mae)
    assert np.isnan(score.mean("speed", 3)).all()  # no window above 12 m/s


def test_baselines_stand_beside_what_is_evaluated():
    table = evaluate([Persistence()], breeze())
    names = [score.name for score in table.scores]
    assert names == ["persistence", "linear autoregression", "conformal persistence"]
    speed, direction = table["linear autoregression"].skill(table["persistence"])
    assert speed > 0.02
    assert direction > 0.02
    assert table["conformal persistence"].mean("speed_in_90").mean() == pytest.approx(0.9, abs=0.04)


def test_faults_are_masked_before_anything_is_scored():
    wind = breeze()
    wind.theta_met[1500:1700] = 1.0
    table = evaluate([], wind)
    assert "masked" in table.notes[0]
    assert table.windows < 2000 / 3 - 31 - 200 + 31


def test_the_report_is_json_with_every_column():
    found = json.loads(json.dumps(report(evaluate([], breeze())), allow_nan=False))
    assert found["series"] == "breeze"
    assert found["step_minutes"] == 5
    assert found["windows"] == 667 - 31
    columns = {
        "name",
        "speed_mae",
        "speed_rmse",
        "direction_mae",
        "direction_rmse",
        "speed_pinball",
        "direction_pinball",
        "coverage_90",
        "by_horizon",
        "by_speed",
    }
    for method in found["methods"]:
        assert columns <= set(method)
        assert [row["minutes"] for row in method["by_horizon"]] == [*range(5, 45, 5)]
        assert [row["speed"] for row in method["by_speed"]][-1] == ">12 m/s"
    assert found["methods"][0]["speed_skill"] == 0
    assert found["methods"][0]["coverage_90"] is None
    assert found["methods"][2]["coverage_90"] == pytest.approx(0.9, abs=0.05)


def test_the_report_is_in_degrees():
    table = evaluate([], breeze())
    assert report(table)["methods"][0]["direction_mae"] == pytest.approx(
        np.degrees(table.scores[0].direction_mae).mean()
    )


def test_the_mean_over_the_horizon_is_the_mean_of_its_steps():
    method = report(evaluate([], breeze()))["methods"][1]
    assert np.mean([row["speed_mae"] for row in method["by_horizon"]]) == pytest.approx(
        method["speed_mae"]
    )
