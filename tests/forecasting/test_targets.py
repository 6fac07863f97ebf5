"""Targets: inputs that do not know the compass, and outputs that mean what they should."""

import numpy as np
import pytest

from windopt.forecasting.targets import RawTarget, ResidualTarget
from windopt.forecasting.windows import Traces

RESIDUAL, RAW = ResidualTarget(), RawTarget()


def winds(B=50, n=24, seed=0):
    """Return breezes that drift and turn, through north as well."""
    rng = np.random.default_rng(seed)
    speed = np.abs(6 + np.cumsum(rng.normal(0, 0.5, (B, n)), axis=1))
    turn = rng.uniform(0, 2 * np.pi, (B, 1)) + np.cumsum(rng.normal(0, 0.1, (B, n)), axis=1)
    return Traces(speed, turn % (2 * np.pi))


def split(traces, at):
    return (
        Traces(traces.speed[:, :at], traces.theta_met[:, :at]),
        Traces(traces.speed[:, at:], traces.theta_met[:, at:]),
    )


def outputs_that_say(truth):
    """Return outputs whose every head says ``truth``."""
    return truth[..., list(RESIDUAL.columns)]


def test_turning_the_compass_changes_no_input():
    past = winds()
    turned = Traces(past.speed, (past.theta_met + 2.0) % (2 * np.pi))
    assert RESIDUAL.encode(turned) == pytest.approx(RESIDUAL.encode(past), abs=1e-5)


def test_turning_the_compass_turns_the_forecast():
    past, future = split(winds(), 16)
    outputs = outputs_that_say(RESIDUAL.truth(past, future))
    turned = Traces(past.speed, (past.theta_met + 2.0) % (2 * np.pi))
    straight, rotated = RESIDUAL.decode(outputs, past), RESIDUAL.decode(outputs, turned)
    assert rotated.speed == pytest.approx(straight.speed)
    assert np.cos(rotated.theta_met - straight.theta_met) == pytest.approx(np.cos(2.0))


def test_the_last_inputs_tell_where_a_steady_change_is_going():
    time = np.arange(24.0)
    past = Traces(5 + 0.1 * time[None], np.full((1, 24), 1.0))
    x = RESIDUAL.encode(past)[0]
    d = np.exp(x[0, 4])
    assert d * x[1:, 5] == pytest.approx(np.full(23, 0.1), rel=1e-5)  # along the wind
    assert x[:, 6] == pytest.approx(np.zeros(24), abs=1e-6)  # across it
    assert d * x[1:, 7] == pytest.approx(np.full(23, 0.1), rel=1e-5)
    assert x[0, 5] == x[0, 7] == 0.0


def test_inputs_that_mirror_change_sign_when_left_and_right_are_exchanged():
    past = winds()
    mirrored = Traces(past.speed, -past.theta_met % (2 * np.pi))
    sign = np.ones(RESIDUAL.inputs)
    sign[list(RESIDUAL.mirror[0])] = -1
    assert RESIDUAL.encode(mirrored) == pytest.approx(sign * RESIDUAL.encode(past), abs=1e-5)


@pytest.mark.parametrize("target", [RESIDUAL, RAW])
def test_outputs_that_equal_the_truth_decode_to_it(target):
    past, future = split(winds(), 16)
    truth = target.truth(past, future)
    ahead = target.decode(truth[..., list(target.columns)], past)
    assert ahead.speed == pytest.approx(future.speed, abs=1e-4)
    assert np.cos(ahead.theta_met - future.theta_met) == pytest.approx(1.0, abs=1e-5)


def test_outputs_of_zero_are_persistence():
    past = winds()
    ahead = RESIDUAL.decode(np.zeros((50, 8, RESIDUAL.outputs), dtype=np.float32), past)
    assert ahead.speed == pytest.approx(np.repeat(past.speed[:, -1:], 8, axis=1))
    assert np.cos(ahead.theta_met - past.theta_met[:, -1:]) == pytest.approx(1.0)


def test_quantiles_surround_the_forecast_whatever_the_network_says():
    rng = np.random.default_rng(0)
    ahead = RESIDUAL.decode(rng.normal(0, 9, (50, 8, RESIDUAL.outputs)), winds())
    assert (np.diff(ahead.quantiles.speed) >= 0).all()
    assert ahead.quantiles.speed[..., 2] == pytest.approx(ahead.speed)
    assert (ahead.quantiles.turn[..., 1] <= 0).all()
    assert (ahead.quantiles.turn[..., 3] >= 0).all()
    assert np.abs(ahead.quantiles.turn).max() < np.pi


def test_twice_the_wind_and_twice_the_fluctuation_look_alike():
    past = winds()
    twice = Traces(2 * past.speed, past.theta_met)
    ratio = np.linalg.norm(RESIDUAL.encode(twice)[..., :3]) / np.linalg.norm(
        RESIDUAL.encode(past)[..., :3]
    )
    assert 1 < ratio < 1.1  # the deviation's floor of 0.05 m/s


def test_a_calm_has_finite_inputs():
    calm = Traces(np.zeros((1, 24)), np.zeros((1, 24)))
    assert np.isfinite(RESIDUAL.encode(calm)).all()
    ahead = RESIDUAL.decode(np.ones((1, 8, RESIDUAL.outputs)), calm)
    assert np.isfinite(ahead.speed).all()


def test_the_papers_inputs_lie_between_zero_and_one():
    x = RAW.encode(winds())
    assert x.min() >= 0
    assert x.max() <= 1
