"""Quantiles of a wind forecast, and coherent wind paths drawn from them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Quantiles:
    r"""How sure a forecast is, for one trace or for many.

    Parameters
    ----------
    levels
        Probabilities, increasing, shape ``(Q,)``.
    speed
        Quantiles of the wind speed [m/s], shape ``(..., H, Q)``.
    turn
        Quantiles of the direction as turns from the forecast one, clockwise [rad], same shape: on
        a circle only differences have an order.
    memory
        How slowly the errors of speed and of direction forget [-]: those at steps h < h' correlate
        by :math:`(h / h')^a`, with an exponent a for each. Brownian motion has 1/2.
    """

    levels: tuple[float, ...]
    speed: Floats
    turn: Floats
    memory: tuple[float, float] = (0.5, 0.5)

    def __post_init__(self) -> None:
        if len(self.levels) < 2:
            raise InvalidInput("levels", "to be two at least", self.levels)
        if not (np.diff(self.levels) > 0).all() or not 0 < self.levels[0] < self.levels[-1] < 1:
            raise InvalidInput("levels", "to increase between 0 and 1", self.levels)
        for name, values in (("speed", self.speed), ("turn", self.turn)):
            if values.shape[-1] != len(self.levels) or values.shape != self.speed.shape:
                raise InvalidInput(f"quantiles of {name}", "one for each level", values.shape)
            if not (np.diff(values, axis=-1) >= 0).all():
                raise InvalidInput(f"quantiles of {name}", "to increase with the level", "others")

    def __getitem__(self, trace: int) -> "Quantiles":
        """Return those of one trace of many."""
        return replace(self, speed=self.speed[trace], turn=self.turn[trace])

    def at(self, levels: Sequence[float]) -> tuple[Floats, Floats]:
        """Return speeds [m/s] and turns [rad] of one trace at any levels, shapes ``(H, L)``."""
        if self.speed.ndim != 2:
            raise InvalidInput("quantiles", "of one trace", f"shape {self.speed.shape}")
        nodes, x = (
            np.array([NormalDist().inv_cdf(p) for p in row]) for row in (self.levels, levels)
        )
        speed, turn = (
            np.array([_quantile(x, nodes, row) for row in values])
            for values in (self.speed, self.turn)
        )
        return np.maximum(speed, 0.0), turn

    def paths(self, n: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Draw speeds [m/s] and turns [rad] over the horizon, shapes ``(n, H)``.

        A Gaussian copula joins the steps; between levels the quantile function is linear in
        standard deviations, and beyond the outermost their slopes go on. Speed and direction are
        drawn independently of each other.
        """
        if self.speed.ndim != 2:
            raise InvalidInput("quantiles", "of one trace", f"shape {self.speed.shape}")
        nodes = np.array([NormalDist().inv_cdf(level) for level in self.levels])
        speed, turn = (
            _draw(nodes, values, a, rng.standard_normal((len(values), n)))
            for values, a in zip((self.speed, self.turn), self.memory, strict=True)
        )
        return np.maximum(speed, 0.0), turn


def _draw(nodes: Floats, values: Floats, a: float, noise: Floats) -> Floats:
    """Paths from independent standard normal ``noise`` ``(H, n)``, shape ``(n, H)``."""
    h = np.log(np.arange(1, len(values) + 1))
    correlation = np.exp(-a * np.abs(h[:, None] - h))
    x = np.linalg.cholesky(correlation + 1e-9 * np.eye(len(h))) @ noise
    return np.stack([_quantile(at, nodes, of) for at, of in zip(x, values, strict=True)], axis=1)


def _quantile(x: Floats, nodes: Floats, values: Floats) -> Floats:
    """Quantile function at ``x`` standard deviations, given ``values`` at ``nodes``."""
    slope = np.diff(values) / np.diff(nodes)
    below, above = np.minimum(x - nodes[0], 0.0), np.maximum(x - nodes[-1], 0.0)
    at: Floats = np.interp(x, nodes, values) + below * slope[0] + above * slope[-1]
    return at
