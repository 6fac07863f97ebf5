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
from windopt.forecasting.targets import wrapped
from windopt.forecasting.windows import chronological_split
from windopt.io.built_in import built_in_series

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


def month():
    """Return the last third of the built-in month, which trained nothing."""
    return chronological_split(built_in_series())[1]


def test_scenarios_keep_the_calibrated_quantiles():
    forecast = EdgeForecaster.shipped(STEPS[1]).predict(month())
    paths = forecast.scenarios(20_000, np.random.default_rng(0))
    speed = np.stack([path.speed for path in paths])
    turn = wrapped(np.stack([path.theta_met for path in paths]) - forecast.theta_met)
    quantiles = forecast.quantiles
    for k, level in enumerate(quantiles.levels):
        for drawn, asked in (speed, quantiles.speed), (turn, quantiles.turn):
            spread = asked[:, -1] - asked[:, 0]
            off = (np.quantile(drawn, level, axis=0) - asked[:, k]) / spread
            assert np.abs(off).max() < 0.03


def test_neighbouring_steps_of_a_scenario_go_together():
    forecast = EdgeForecaster.shipped(STEPS[0]).predict(gusty(STEPS[0]))
    speed = np.stack([path.speed for path in forecast.scenarios(5000, np.random.default_rng(0))])
    correlation = np.corrcoef(speed, rowvar=False)
    assert (np.diag(correlation, 1) > 0.6).all()
    assert (np.diff(correlation[0]) < 0).all()
    a, h = forecast.quantiles.memory[0], np.arange(1, 9)
    assert correlation[-1] == pytest.approx((h / 8) ** a, abs=0.05)


def test_what_came_was_as_likely_as_the_scenarios_said():
    """The mean over the horizon has the right spread only if the steps hang together."""
    wind, rng, below = month(), np.random.default_rng(0), []
    forecaster = EdgeForecaster.shipped(wind.step)
    for now in range(20, len(wind) - 4, 12):
        paths = forecaster.predict(wind.part(slice(0, now))).scenarios(200, rng)
        means = [path.speed.mean() for path in paths]
        below.append(np.mean(means < wind.speed[now : now + 4].mean()))
    inside = (np.array(below) > 0.05) & (np.array(below) < 0.95)
    assert inside.mean() == pytest.approx(0.9, abs=0.08)  # three standard deviations of 120


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
