"""The trained models that come with the package, without torch."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.evaluation import backtest
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.quantisation import Levels

STEPS = [np.timedelta64(5, "m"), np.timedelta64(10, "m")]


def gusty(step, n=3000, seed=0):
    """Return a wind with the fluctuations of a mast: a slow drift and a quick one."""
    rng = np.random.default_rng(seed)

    def drift(pull, push):
        x = np.zeros(n)
        for i in range(1, n):
            x[i] = (1 - pull) * x[i - 1] + rng.normal(0, push)
        return x

    speed = np.abs(8 + drift(0.005, 0.2) + drift(0.5, 0.5))
    turn = 1.0 + drift(0.005, 0.03) + drift(0.5, 0.06)
    return WindSeries(
        np.datetime64("2020-01-01T00:00") + step * np.arange(n), speed, turn % (2 * np.pi)
    )


@pytest.mark.parametrize("step", STEPS)
def test_shipped_models_have_four_bits_and_fit_into_30_kilobytes(step, tmp_path):
    model = EdgeForecaster.shipped(step)
    model.save(tmp_path / "model.npz")
    assert (tmp_path / "model.npz").stat().st_size < 30_000
    assert {(m.bits, m.levels) for m in model.model.weights.matrices} == {(4, Levels.HALF)}


@pytest.mark.parametrize("step", STEPS)
def test_shipped_models_beat_persistence_on_a_wind_they_never_saw(step):
    table = EdgeForecaster.shipped(step).backtest(gusty(step))
    speed, direction = table["lstm"].skill(table["persistence"])
    assert speed > 0.02
    assert direction > 0.02


@pytest.mark.parametrize("step", STEPS)
def test_shipped_bands_cover_about_what_they_say_on_a_wind_they_never_saw(step):
    found = EdgeForecaster.shipped(step).backtest(gusty(step))["lstm"]
    assert 0.8 < found.mean("speed_in_90").mean() < 0.98
    assert 0.8 < found.mean("direction_in_90").mean() < 0.98


@pytest.mark.parametrize("step", STEPS)
def test_turning_the_compass_turns_the_forecast(step):
    wind, turned = gusty(step), gusty(step)
    turned.theta_met[:] = (turned.theta_met + 2.0) % (2 * np.pi)
    straight, rotated = (EdgeForecaster.shipped(step).predict(one) for one in (wind, turned))
    assert rotated.speed == pytest.approx(straight.speed, abs=1e-4)
    assert np.cos(rotated.theta_met - straight.theta_met) == pytest.approx(np.cos(2.0), abs=1e-4)


@pytest.mark.parametrize("arithmetic", ["integer", "sparse"])
@pytest.mark.parametrize("step", STEPS)
def test_integers_and_sparse_products_forecast_as_well_as_floats(step, arithmetic):
    wind = gusty(step, 1000)
    floats = EdgeForecaster.shipped(step).backtest(wind)["lstm"]
    others = EdgeForecaster.shipped(step, arithmetic=arithmetic).backtest(wind)["lstm"]
    assert others.speed_mae == pytest.approx(floats.speed_mae, rel=0.01)
    assert others.direction_mae == pytest.approx(floats.direction_mae, rel=0.01)


def test_the_model_is_chosen_by_the_step_of_the_series():
    for step in STEPS:
        wind = gusty(step, 200)
        chosen = EdgeForecaster().fit(wind)
        assert chosen.model.step == step
        assert len(chosen.predict(wind)) == int(np.timedelta64(40, "m") / step)
        assert chosen.fit(wind) is chosen


@pytest.mark.parametrize(("minutes", "takes"), [(1, 5), (2, 10), (5, 5), (10, 10)])
def test_rows_that_come_oftener_are_averaged(minutes, takes):
    wind = gusty(np.timedelta64(minutes, "m"), 400)
    forecaster = EdgeForecaster().fit(wind)
    forecast = forecaster.predict(wind)
    assert forecaster.model.step == np.timedelta64(takes, "m")
    assert forecast.issued == wind.time[-1]
    assert len(forecast) == 40 // takes
    assert (forecaster.suited(wind) is wind) == (minutes == takes)
    assert any("Means over" in note for note in forecast.notes) == (minutes != takes)


def test_a_vane_that_was_stuck_before_averaging_is_mentioned():
    wind = gusty(np.timedelta64(1, "m"), 400)
    wind.theta_met[-150:] = 1.0
    assert any(
        "120 of the last 120 rows" in note
        for note in EdgeForecaster().fit(wind).predict(wind).notes
    )


def test_a_step_without_a_model_is_refused():
    with pytest.raises(InvalidInput, match="5 or 10 minutes"):
        EdgeForecaster().fit(gusty(np.timedelta64(20, "m"), 100))
    with pytest.raises(InvalidInput, match="step"):
        EdgeForecaster.shipped(STEPS[0]).predict(gusty(STEPS[1], 100))
    with pytest.raises(InvalidInput, match="fitted first"):
        EdgeForecaster().predict(gusty(STEPS[0], 100))


def test_floating_point_weights_have_no_integers():
    model = EdgeForecaster.shipped(STEPS[0]).model
    floats = replace(model, weights=model.float_weights)
    with pytest.raises(InvalidInput, match="arithmetic"):
        EdgeForecaster(floats, "integer")


@pytest.mark.parametrize("speed", [0.0, 0.01, 40.0])
def test_calms_and_storms_get_finite_forecasts_with_bands(speed):
    wind = gusty(STEPS[0], 60)
    wind.speed[:] = speed
    wind.theta_met[:] = 1.0
    forecast = EdgeForecaster.shipped(STEPS[0]).predict(wind)
    assert np.abs(forecast.speed - speed).max() < 0.15 * speed + 0.5
    assert np.isfinite(forecast.quantiles.turn).all()


def test_it_stands_beside_other_forecasters():
    wind = gusty(STEPS[0])
    rivals = [LinearAutoregression().fit(wind), EdgeForecaster().fit(wind)]
    assert [score.name for score in backtest(rivals, wind).scores] == [
        "persistence",
        "linear autoregression",
        "lstm",
    ]


def test_without_torch_forecasts_work_and_training_names_the_extra():
    program = (
        "import sys, numpy as np\n"
        "sys.modules['torch'] = None\n"
        "from windopt.domain.wind import WindSeries\n"
        "from windopt.errors import MissingExtra\n"
        "from windopt.forecasting.lstm import EdgeForecaster, WindForecaster\n"
        "time = np.datetime64('2020-01-01T00:00') + np.timedelta64(5, 'm') * np.arange(30)\n"
        "EdgeForecaster().fit(s := WindSeries(time, np.ones(30), np.ones(30))).predict(s)\n"
        "try:\n"
        "    WindForecaster().fit(s)\n"
        "except MissingExtra as missing:\n"
        "    assert 'windopt[train]' in str(missing)\n"
        "else:\n"
        "    raise AssertionError\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
