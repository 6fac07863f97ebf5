"""Calibration: quantiles that were wrong in a known way come out right."""

import numpy as np
import pytest

from windopt.domain.quantiles import Quantiles
from windopt.forecasting.calibration import Calibration, calibrate
from windopt.forecasting.targets import LEVELS
from windopt.forecasting.windows import Traces

STANDARD = np.array([-1.645, -0.674, 0.0, 0.674, 1.645])


def cases(B=4000, width=1.0, seed=0, memory=0.5):
    """Errors are standard normal Brownian; the forecast says they are ``width`` wide."""
    rng = np.random.default_rng(seed)
    last = rng.uniform(1, 16, (B, 1))
    h = np.arange(1, 9.0)
    correlation = np.exp(-memory * np.abs(np.log(h)[:, None] - np.log(h)))
    noise = rng.standard_normal((2, B, 8)) @ np.linalg.cholesky(correlation).T
    past = Traces(np.repeat(last, 24, axis=1), np.ones((B, 24)))
    speed = np.full((B, 8), 30.0)  # far from a calm, which would cut the errors
    turn = np.full((B, 8), 1.0)
    quantiles = Quantiles(
        LEVELS,
        speed[..., None] + width * STANDARD,
        np.broadcast_to(0.1 * width * STANDARD, (B, 8, 5)),
    )
    future = Traces(speed + noise[0], turn + 0.1 * noise[1])
    return Traces(speed, turn, quantiles), past, future


def coverage(ahead, future):
    q = ahead.quantiles
    inside = (future.speed >= q.speed[..., 0]) & (future.speed <= q.speed[..., 4])
    turn = future.theta_met - ahead.theta_met
    return inside, (turn >= q.turn[..., 0]) & (turn <= q.turn[..., 4])


@pytest.mark.parametrize("width", [0.5, 1.0, 2.0])
def test_bands_of_the_wrong_width_come_to_cover_90_per_cent(width):
    calibration = calibrate([cases(width=width)])
    ahead, past, future = cases(width=width, seed=1)
    for inside in coverage(calibration.apply(ahead, past), future):
        assert inside.mean() == pytest.approx(0.9, abs=0.015)


def test_each_class_of_speed_is_calibrated_for_itself():
    ahead, past, future = cases()
    light = past.speed[:, -1] < 4
    future.speed[light] = ahead.speed[light] + 3 * (future.speed - ahead.speed)[light]
    inside, _ = coverage(calibrate([(ahead, past, future)]).apply(ahead, past), future)
    assert inside[light].mean() == pytest.approx(0.9, abs=0.01)
    assert inside[~light].mean() == pytest.approx(0.9, abs=0.01)


def test_smooth_and_rough_winds_are_calibrated_apart():
    ahead, past, future = cases()
    rough = np.arange(4000) % 2 == 1
    past.speed[rough, 1:-1:2] *= 1.3
    future.speed[rough] = ahead.speed[rough] + 3 * (future.speed - ahead.speed)[rough]
    inside, _ = coverage(calibrate([(ahead, past, future)]).apply(ahead, past), future)
    assert inside[rough].mean() == pytest.approx(0.9, abs=0.01)
    assert inside[~rough].mean() == pytest.approx(0.9, abs=0.01)


def test_good_bands_are_left_nearly_as_they_are():
    found = calibrate([cases(B=10_000)])
    assert found.speed == pytest.approx(np.ones((8, 5)), abs=0.1)


@pytest.mark.parametrize("memory", [0.3, 0.5, 0.9])
def test_the_memory_of_errors_is_found(memory):
    assert calibrate([cases(memory=memory)]).memory == pytest.approx([memory] * 2, abs=0.1)


def test_a_class_with_few_windows_keeps_its_quantiles():
    ahead, past, future = cases(B=20, width=0.1)
    assert calibrate([(ahead, past, future)]).speed.tolist() == np.ones((8, 5)).tolist()


def test_no_calibration_changes_nothing():
    ahead, past, _ = cases(B=10)
    assert Calibration.none().apply(ahead, past).quantiles.speed == pytest.approx(
        ahead.quantiles.speed
    )


def test_forecasts_without_quantiles_pass_through():
    ahead, past, future = cases(B=10)
    bare = Traces(ahead.speed, ahead.theta_met)
    assert calibrate([(bare, past, future)]).apply(bare, past) is bare
