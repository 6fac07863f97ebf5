"""Quantisation while training: rounded values forward, whole gradients back."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from windopt.forecasting.network import FloatNetwork  # noqa: E402
from windopt.forecasting.quantisation import Levels  # noqa: E402
from windopt.forecasting.training.module import LstmModule, Shape  # noqa: E402

RAW = ("lstm.parametrizations.weight_ih_l0.original", "lstm.parametrizations.weight_hh_l0.original")


def module(bits=4, output_bits=4, levels=Levels.HALF, units=12):
    torch.manual_seed(0)
    return LstmModule(Shape(3, 5, units, bits, output_bits, levels))


def inputs(B=9):
    return torch.randn(B, 7, 3, generator=torch.Generator().manual_seed(1))


@pytest.mark.parametrize("bits", [2, 4, 8, 16])
def test_gradients_reach_every_raw_weight(bits):
    quantised = module(bits, bits)
    quantised(inputs()).square().sum().backward()
    for name, parameter in quantised.named_parameters():
        if name != "lstm.bias_hh_l0":
            assert parameter.grad is not None, name
            assert (parameter.grad != 0).float().mean() > 0.99, name


def test_the_gradient_is_that_of_the_network_with_the_rounded_weights():
    quantised, rounded = module(), module(32, 32)
    state = rounded.state_dict()
    weights = quantised.raw_weights().rounded(4, 4)
    for name, value in (
        ("lstm.weight_ih_l0", weights.W),
        ("lstm.weight_hh_l0", weights.U),
        ("output.weight", weights.W_y),
    ):
        state[name] = torch.from_numpy(value)
    rounded.load_state_dict(state)
    for one in (quantised, rounded):
        one(inputs()).square().sum().backward()
    found, expected = dict(quantised.named_parameters()), dict(rounded.named_parameters())
    for name in RAW:
        plain = name.replace("parametrizations.", "").replace(".original", "")
        assert torch.allclose(found[name].grad, expected[plain].grad, atol=1e-5)


def test_clipped_weights_still_receive_a_gradient():
    quantised = module()
    raw = dict(quantised.named_parameters())[RAW[1]]
    with torch.no_grad():
        raw[0] *= 100
    quantised(inputs()).square().sum().backward()
    assert (raw.grad[0] != 0).all()


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize(("bits", "output_bits"), [(2, 2), (4, 4), (8, 2), (4, 32), (32, 4)])
def test_numpy_runs_the_very_network_that_torch_trained(bits, output_bits, levels):
    trained = module(bits, output_bits, levels)
    x = inputs()
    with torch.no_grad():
        expected = trained(x).numpy()
    weights = trained.raw_weights().rounded(bits, output_bits, levels=levels)
    assert FloatNetwork(weights)(x.numpy()) == pytest.approx(expected, abs=1e-5)


def test_a_step_of_descent_moves_weights_within_their_level_too():
    quantised = module(2, 2)
    before = {name: value.clone() for name, value in quantised.state_dict().items()}
    optimiser = torch.optim.SGD(quantised.parameters(), lr=1e-4)
    quantised(inputs()).square().sum().backward()
    optimiser.step()
    after = quantised.state_dict()
    for name in RAW:
        assert not torch.equal(before[name], after[name])


def test_the_second_bias_stays_zero():
    trained = module()
    assert not trained.state_dict()["lstm.bias_hh_l0"].any()
    assert np.allclose(trained.raw_weights().b[12:24], 1.0)
