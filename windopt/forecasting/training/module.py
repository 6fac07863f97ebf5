"""The network as torch trains it, and its way out into NumPy."""

from dataclasses import dataclass
from functools import partial

import torch
from torch import Tensor, nn
from torch.nn.utils import parametrize

from windopt.forecasting.network import Weights
from windopt.forecasting.quantisation import FLOAT, GAMMA, Levels
from windopt.forecasting.training.straight_through import quantise_while_training


@dataclass(frozen=True)
class Shape:
    """Sizes of a network and the bits of its weights.

    Parameters
    ----------
    inputs, units, outputs
        Inputs at each step, hidden units, and outputs altogether.
    bits, output_bits
        omega_w of the gates and omega_f of the output layer; 32 is floating point.
    levels, gamma
        Which levels the weights take, and how many medians wide they span.
    """

    inputs: int
    outputs: int
    units: int = 100
    bits: int = FLOAT
    output_bits: int = FLOAT
    levels: Levels = Levels.HALF
    gamma: float = GAMMA


class LstmModule(nn.Module):
    """One LSTM layer and a linear output, quantised as ``shape`` says."""

    def __init__(self, shape: Shape) -> None:
        super().__init__()
        self.lstm = nn.LSTM(shape.inputs, shape.units, batch_first=True)
        self.output = nn.Linear(shape.units, shape.outputs)
        self._start_with_one_bias(shape.units)
        quantise = partial(quantise_while_training, levels=shape.levels, gamma=shape.gamma)
        for name in "weight_ih_l0", "weight_hh_l0":
            quantise(self.lstm, name, shape.bits, blocks=4)
        quantise(self.output, "weight", shape.output_bits)

    def _start_with_one_bias(self, n: int) -> None:
        """Leave one of torch's two biases out, and let the forget gate begin open."""
        parameters = dict(self.lstm.named_parameters())
        with torch.no_grad():
            parameters["bias_hh_l0"].zero_()
            parameters["bias_ih_l0"][n : 2 * n] = 1.0
        parameters["bias_hh_l0"].requires_grad = False

    def forward(self, x: Tensor) -> Tensor:
        """Return the outputs ``(B, m)`` for the inputs ``(B, L, d)``."""
        with parametrize.cached():
            states, _ = self.lstm(x)
            y: Tensor = self.output(states[:, -1])
        return y

    def begin_at(self, outputs: Tensor) -> None:
        """Let the network say ``outputs`` on average."""
        with torch.no_grad():
            self.output.bias.copy_(outputs.flatten())

    def begin_with(self, weights: Weights) -> None:
        """Take over ``weights`` as the ones before quantisation."""
        values = {
            "lstm.weight_ih_l0": weights.W,
            "lstm.weight_hh_l0": weights.U,
            "lstm.bias_ih_l0": weights.b,
            "output.weight": weights.W_y,
            "output.bias": weights.b_y,
        }
        with torch.no_grad():
            for name, parameter in self.named_parameters():
                if _plain(name) in values:
                    parameter.copy_(torch.from_numpy(values[_plain(name)]))

    def raw_weights(self) -> Weights:
        """Return the weights before quantisation; torch stacks the gates in the same order."""
        arrays = {_plain(name): value.numpy().copy() for name, value in self.state_dict().items()}
        return Weights(
            arrays["lstm.weight_ih_l0"],
            arrays["lstm.weight_hh_l0"],
            arrays["lstm.bias_ih_l0"],
            arrays["output.weight"],
            arrays["output.bias"],
        )


def _plain(name: str) -> str:
    """Name of a parameter as it is without parametrisation."""
    return name.replace("parametrizations.", "").replace(".original", "")
