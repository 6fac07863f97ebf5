r"""Targets: what the network sees and what its outputs mean.

Ours works in a frame that turns with the wind: its first axis is the direction last measured, so
what is learnt at one site in one wind holds for every compass bearing. In this frame the network
sees how velocity :math:`(a, c)` and speed s differed from the last, in units of how much the wind
has fluctuated lately,

.. math::

    d = 0.05\,\mathrm{m/s} + \sqrt{\operatorname{mean}(\Delta a^2 + \Delta c^2) / 2},

d and the last speed themselves, as logarithms, and how velocity and speed changed since the row
before. The latest change says where a smooth wind is going; left to differences of the others, it
drowns in weights of 4 bits.

The network's outputs are residuals on persistence in the same units: of the velocity, whose angle
is the direction forecast; of the speed, five quantiles whose median is the speed forecast; and of
the direction, four quantiles around the angle. A mean velocity is shorter than the mean speed,
hence the two heads.

The paper's way is kept beside it: speed and direction between 0 and 1, the angle cut at north.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import Floats
from windopt.forecasting.windows import Traces

Single = NDArray[np.float32]

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
DEVIATION_MIN = 0.05  # m/s; below it anemometers see their own resolution
SPEED_MIN = 0.5  # m/s; about what it takes to turn a vane
TURN_LIMIT = 0.999 * np.pi


class Target(Protocol):
    """A way to write windows as inputs, and outputs as forecasts."""

    @property
    def name(self) -> str:
        """What model files call it."""

    @property
    def inputs(self) -> int:
        """Number of inputs at each step, d."""

    @property
    def outputs(self) -> int:
        """Number of outputs for each step ahead."""

    @property
    def columns(self) -> tuple[int, ...]:
        """Which component of the truth each output is about."""

    @property
    def mirror(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Inputs and truths that change sign when left and right are exchanged."""

    def encode(self, past: Traces) -> Single:
        """Return the inputs, shape ``(B, L, d)``, before they are standardised."""

    def truth(self, past: Traces, future: Traces) -> Single:
        """Return what the outputs should be, shape ``(B, H, ...)``, before standardising."""

    def decode(self, outputs: Single, past: Traces) -> Traces:
        """Return the forecast that outputs ``(B, H, k)`` mean."""


def wrapped(angle: Floats) -> Floats:
    """Return ``angle`` [rad] in [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _in_frame(traces: Traces, past: Traces) -> tuple[Floats, Floats, Floats]:
    """Velocity along and across the last direction [m/s], and the turn from it [rad]."""
    turn = wrapped(traces.theta_met - past.theta_met[:, -1:])
    speed = traces.speed + SPEED_MIN
    return speed * np.cos(turn), speed * np.sin(turn), turn


def deviation(past: Traces) -> Floats:
    """D, how much the wind fluctuates from row to row [m/s], shape ``(B, 1)``."""
    a, c, _ = _in_frame(past, past)
    square = np.diff(a, axis=1) ** 2 + np.diff(c, axis=1) ** 2
    d: Floats = DEVIATION_MIN + np.sqrt(square.mean(axis=1, keepdims=True) / 2)
    return d


@dataclass(frozen=True)
class ResidualTarget:
    """Residuals on persistence in a frame that turns with the wind.

    Velocities are those of a wind stronger by ``SPEED_MIN``, so that the turns of a vane in a calm
    do not count as much as they are wide.
    """

    name: str = "residual"
    inputs: int = 8
    outputs: int = 2 + len(LEVELS) + len(LEVELS) - 1
    columns: tuple[int, ...] = (0, 1, *[2] * len(LEVELS), *[3] * (len(LEVELS) - 1))
    mirror: tuple[tuple[int, ...], tuple[int, ...]] = ((1, 6), (1, 3))

    def encode(self, past: Traces) -> Single:
        """Return velocity and speed less the last, the last speed, the deviation, and changes."""
        a, c, _ = _in_frame(past, past)
        s, d = past.speed[:, -1:], deviation(past)
        level = np.broadcast_to(np.log1p(s), a.shape)
        spread = np.broadcast_to(np.log(d), a.shape)
        changes = (np.diff(z, axis=1, prepend=z[:, :1]) / d for z in (a, c, past.speed))
        since = (a - a[:, -1:]) / d, c / d, (past.speed - s) / d
        return np.stack([*since, level, spread, *changes], axis=-1).astype(np.float32)

    def truth(self, past: Traces, future: Traces) -> Single:
        """Return the residuals of velocity, of speed and of direction, shape ``(B, H, 4)``."""
        a, c, turn = _in_frame(future, past)
        s, d = past.speed[:, -1:], deviation(past)
        last = s + SPEED_MIN
        y = np.stack([(a - last) / d, c / d, (future.speed - s) / d, turn * last / d], axis=-1)
        return y.astype(np.float32)

    def decode(self, outputs: Single, past: Traces) -> Traces:
        """Return direction from the velocity, speed from its median, and both with quantiles."""
        y = outputs.astype(float)
        s, d = past.speed[:, -1:], deviation(past)
        theta = np.arctan2(d * y[..., 1], s + SPEED_MIN + d * y[..., 0])
        speed = np.sort(np.maximum(s[..., None] + d[..., None] * y[..., 2:7], 0.0), axis=-1)
        bounds = (d / (s + SPEED_MIN))[..., None] * y[..., 7:] - theta[..., None]
        low, high = (
            np.sort(np.minimum(bounds[..., :2], 0.0)),
            np.sort(np.maximum(bounds[..., 2:], 0.0)),
        )
        turn = np.concatenate([low, np.zeros_like(low[..., :1]), high], axis=-1)
        return Traces(
            speed[..., 2],
            (past.theta_met[:, -1:] + theta) % (2 * np.pi),
            Quantiles(LEVELS, speed, np.clip(turn, -TURN_LIMIT, TURN_LIMIT)),
        )


@dataclass(frozen=True)
class RawTarget:
    """The paper's target: speed and direction, each divided by its range.

    Parameters
    ----------
    speed_range
        The speed that counts as 1 [m/s].
    """

    speed_range: float = 30.0
    name: str = "raw"
    inputs: int = 2
    outputs: int = 2
    columns: tuple[int, ...] = (0, 1)
    mirror: tuple[tuple[int, ...], tuple[int, ...]] = ((), ())

    def encode(self, past: Traces) -> Single:
        """Return speed and direction between 0 and 1."""
        turn = past.theta_met % (2 * np.pi) / (2 * np.pi)
        return np.stack([past.speed / self.speed_range, turn], axis=-1).astype(np.float32)

    def truth(self, past: Traces, future: Traces) -> Single:
        """Return the same of what followed."""
        return self.encode(future)

    def decode(self, outputs: Single, past: Traces) -> Traces:
        """Return speed and direction in their own units."""
        y = outputs.astype(float)
        return Traces(
            np.maximum(y[..., 0], 0.0) * self.speed_range, 2 * np.pi * y[..., 1] % (2 * np.pi)
        )


TARGETS: dict[str, Target] = {target.name: target for target in (ResidualTarget(), RawTarget())}
