"""Training, from a series to a model, on winds whose law is learnt in seconds."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("torch")

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.evaluation import backtest
from windopt.forecasting.lstm import EdgeForecaster, WindForecaster
from windopt.forecasting.training.fit import Recipe, fit
from windopt.forecasting.training.loop import Schedule

QUICK = Recipe(
    units=12,
    schedule=Schedule(epochs=5, batch=64, rate=2e-2),
    refinement=Schedule(epochs=3, batch=64, rate=1e-2),
)


def swinging(n=3000, seed=0, step=5):
    """Return a wind whose speed and direction swing within two hours, with some noise."""
    rng = np.random.default_rng(seed)
    phase = 2 * np.pi * np.arange(n) / (120 / step)
    time = np.datetime64("2020-01-01T00:00") + np.timedelta64(step, "m") * np.arange(n)
    speed = 9 + 2 * np.sin(phase) + rng.normal(0, 0.1, n)
    direction = np.radians(350) + 0.5 * np.sin(phase + 1) + rng.normal(0, 0.02, n)
    return WindSeries(time, speed, direction % (2 * np.pi))


@pytest.fixture(scope="module")
def trained():
    return EdgeForecaster(fit(QUICK, [swinging()]))


def test_a_swing_is_learnt_at_four_bits(trained):
    table = trained.backtest(swinging(1000, seed=1))
    speed, direction = table["lstm"].skill(table["persistence"])
    assert speed > 0.7
    assert direction > 0.7


def test_bands_cover_what_they_say(trained):
    found = trained.backtest(swinging(1500, seed=2))["lstm"]
    assert found.mean("speed_in_90").mean() == pytest.approx(0.9, abs=0.05)
    assert found.mean("direction_in_90").mean() == pytest.approx(0.9, abs=0.05)


@pytest.mark.parametrize("arithmetic", ["integer", "sparse"])
def test_the_arithmetic_hardly_matters(trained, arithmetic, tmp_path):
    trained.save(tmp_path / "model.npz")
    other = EdgeForecaster.load(tmp_path / "model.npz", arithmetic=arithmetic)
    wind = swinging(200, seed=3)
    assert other.predict(wind).speed == pytest.approx(trained.predict(wind).speed, abs=0.05)


def test_a_forecast_comes_with_scenarios(trained):
    forecast = trained.predict(swinging(100))
    assert len(forecast) == 8
    assert len(forecast.scenarios(20, np.random.default_rng(0))) == 20


def test_the_same_seed_trains_the_same_model(trained):
    assert EdgeForecaster(fit(QUICK, [swinging()])).predict(swinging()).speed.tolist() == (
        trained.predict(swinging()).speed.tolist()
    )


@pytest.mark.parametrize("stop_after", [2, 6])
def test_a_training_that_was_interrupted_ends_where_it_would_have(trained, tmp_path, stop_after):
    class StoppedError(Exception):
        pass

    def stop(epoch):
        seen.append(epoch.number)
        if len(seen) == stop_after:
            raise StoppedError

    seen: list[int] = []
    checkpoint = tmp_path / "training.pt"
    with pytest.raises(StoppedError):
        fit(QUICK, [swinging()], progress=stop, checkpoint=checkpoint)
    resumed = fit(
        QUICK, [swinging()], progress=lambda epoch: seen.append(epoch.number), checkpoint=checkpoint
    )
    assert seen == [1, 2, 3, 4, 5, 1, 2, 3]
    assert EdgeForecaster(resumed).predict(swinging()).speed == pytest.approx(
        trained.predict(swinging()).speed
    )


def test_a_checkpoint_that_is_damaged_or_of_another_network_is_refused(tmp_path):
    short = replace(QUICK, schedule=Schedule(epochs=1), refinement=Schedule(epochs=1))
    checkpoint = tmp_path / "training.pt"
    fit(short, [swinging(600)], checkpoint=checkpoint)
    with pytest.raises(InvalidInput, match="checkpoint"):
        fit(replace(short, units=7), [swinging(600)], checkpoint=checkpoint)
    checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    with pytest.raises(InvalidInput, match="checkpoint"):
        fit(short, [swinging(600)], checkpoint=checkpoint)


def test_training_stops_when_it_no_longer_helps():
    seen = []
    noise = swinging(400)
    noise.speed[:] = np.random.default_rng(0).uniform(1, 9, 400)
    schedule = Schedule(epochs=40, patience=2, batch=64, rate=0.1)
    recipe = replace(QUICK, schedule=schedule, refinement=schedule)
    fit(recipe, [noise], progress=seen.append)
    assert len(seen) < 80
    assert not any(epoch.best for epoch in seen[-2:])


def test_several_series_train_one_model():
    model = fit(QUICK, [swinging(800), swinging(900, seed=5)])
    assert model.horizon == np.timedelta64(40, "m")


@pytest.mark.parametrize("target", ["residual", "raw"])
@pytest.mark.parametrize("bits", [2, 32])
def test_every_target_trains_at_every_width(target, bits):
    once = Schedule(epochs=1)
    recipe = replace(QUICK, target=target, bits=bits, schedule=once, refinement=once)
    model = EdgeForecaster(fit(recipe, [swinging(600, step=10)]))
    assert len(model.predict(swinging(60, step=10))) == 4
    assert backtest([model], swinging(200, step=10)).windows > 0


def test_a_series_too_short_to_split_is_refused():
    with pytest.raises(InvalidInput, match="rows"):
        WindForecaster().fit(swinging(60))


def test_series_of_different_steps_are_refused():
    with pytest.raises(InvalidInput, match="one step"):
        fit(QUICK, [swinging(), swinging(step=10)])


def test_a_stuck_vane_trains_nothing():
    wind = swinging()
    wind.theta_met[:] = 1.0
    with pytest.raises(InvalidInput, match="valid rows"):
        WindForecaster(QUICK).fit(wind)
