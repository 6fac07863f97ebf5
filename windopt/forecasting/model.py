"""A trained model: weights, the scaling of inputs and outputs, and the calibration of quantiles."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.forecasting.calibration import Calibration
from windopt.forecasting.network import Network, QuantisedWeights, Weights
from windopt.forecasting.targets import TARGETS, Target
from windopt.forecasting.windows import Traces, steps_in

Single = NDArray[np.float32]


@dataclass(frozen=True)
class Scaling:
    """How inputs are standardised, and what outputs count.

    Parameters
    ----------
    mean, deviation
        Of each input, shape ``(d,)``; the network sees (x - mean) / deviation.
    outputs
        Of each output at each step ahead, shape ``(H, k)``.
    """

    mean: Single
    deviation: Single
    outputs: Single


@dataclass(frozen=True)
class Model:
    """Everything that a forecast takes; a file holds it, and no more.

    Parameters
    ----------
    target
        Name of the way in which inputs and outputs are written.
    step, history, horizon
        The series it is for.
    weights
        In floating point or quantised.
    """

    target: str
    step: np.timedelta64
    history: np.timedelta64
    horizon: np.timedelta64
    weights: Weights | QuantisedWeights
    scaling: Scaling
    calibration: Calibration

    def __post_init__(self) -> None:
        if self.target not in TARGETS:
            raise InvalidInput("target", f"among {', '.join(TARGETS)}", self.target)
        H = steps_in(self.horizon, self.step, "horizon")
        way = TARGETS[self.target]
        for name, array, shape in (
            ("input mean", self.scaling.mean, (way.inputs,)),
            ("input deviation", self.scaling.deviation, (way.inputs,)),
            ("output scale", self.scaling.outputs, (H, way.outputs)),
            ("gate bias", self.weights.b, (4 * self.units,)),
            ("output bias", self.weights.b_y, (H * way.outputs,)),
        ):
            if array.shape != shape:
                raise InvalidInput(name, f"of shape {shape}", array.shape)
            if not np.isfinite(array).all():
                raise InvalidInput(name, "to be finite", "NaN or infinity")

    @property
    def units(self) -> int:
        """Number of hidden units."""
        return len(self.weights.b) // 4

    def with_calibration(self, calibration: Calibration) -> "Model":
        """Return the model with other factors on its quantiles."""
        return replace(self, calibration=calibration)

    @property
    def float_weights(self) -> Weights:
        """The weights as floats, on their levels if they are quantised."""
        weights = self.weights
        return weights.weights if isinstance(weights, QuantisedWeights) else weights

    @property
    def way(self) -> Target:
        """How inputs and outputs are written."""
        return TARGETS[self.target]

    def standardised(self, past: Traces) -> Single:
        """Return the inputs of the network, shape ``(B, L, d)``."""
        x: Single = (self.way.encode(past) - self.scaling.mean) / self.scaling.deviation
        return x

    def forecast(self, network: Network, past: Traces) -> Traces:
        """Return the calibrated forecast that ``network`` makes of ``past``."""
        outputs = network(self.standardised(past)).reshape(len(past), *self.scaling.outputs.shape)
        ahead = self.way.decode(outputs * self.scaling.outputs, past)
        return self.calibration.apply(ahead, past)
