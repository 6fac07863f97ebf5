"""Calibration: quantiles widened or narrowed until they cover what they say, at every wind speed.

Split-conformal prediction on windows that trained nothing: for each class and each level p, the
distance between quantile and median is multiplied by the p-quantile of (truth - median) /
(quantile - median). Classes are those of the last measured speed, as a direction is much less
certain in a light wind, each split into smooth and rough by how much the wind has fluctuated for
its speed: over the sea and in a weather model it is smooth, near the ground rough. See Romano,
Patterson & Candes (2019), arXiv:1905.03222.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import Floats
from windopt.errors import InvalidInput
from windopt.forecasting.targets import LEVELS, SPEED_MIN, TURN_LIMIT, deviation, wrapped
from windopt.forecasting.windows import Traces

SPEED_CLASSES = (4.0, 8.0, 12.0)  # m/s, edges between four classes
ROUGH = 0.06  # fluctuation over speed from which on a wind is rough [-]
CLASSES = 2 * (len(SPEED_CLASSES) + 1)
FEW = 300  # truths in a class, below which it keeps the quantiles as they are
FACTOR_LIMITS = (0.25, 4.0)

Classes = NDArray[np.intp]


def speed_class(past: Traces) -> Classes:
    """Return the class of the last measured speed, shape ``(B,)``."""
    return np.digitize(past.speed[:, -1], SPEED_CLASSES)


def calibration_class(past: Traces) -> Classes:
    """Return the class of speed and roughness, shape ``(B,)``."""
    rough = deviation(past)[:, 0] > ROUGH * (past.speed[:, -1] + SPEED_MIN)
    return 2 * speed_class(past) + rough


@dataclass(frozen=True)
class Calibration:
    """Factors on the distance of each quantile from the median.

    Parameters
    ----------
    speed, turn
        For each class and each level [-], shape ``(8, Q)``.
    memory
        See :class:`windopt.domain.quantiles.Quantiles`.
    """

    speed: Floats
    turn: Floats
    memory: tuple[float, float] = (0.5, 0.5)

    def __post_init__(self) -> None:
        shape = (CLASSES, len(LEVELS))
        for name, factors in (("speed", self.speed), ("turn", self.turn)):
            if factors.shape != shape or not (factors >= 0).all() or not np.isfinite(factors).all():
                raise InvalidInput(f"calibration of {name}", f">= 0, of shape {shape}", factors)
        if not all(0 <= a < np.inf for a in self.memory):
            raise InvalidInput("memory of errors", ">= 0", self.memory)

    @classmethod
    def none(cls) -> "Calibration":
        """Leave quantiles as they are."""
        ones = np.ones((CLASSES, len(LEVELS)))
        return cls(ones, ones)

    def apply(self, ahead: Traces, past: Traces) -> Traces:
        """Return the forecast with calibrated quantiles."""
        if ahead.quantiles is None:
            return ahead
        of = calibration_class(past)
        middle = ahead.speed[..., None]
        away = ahead.quantiles.speed - middle
        speed = np.maximum(middle + away * self.speed[of, None, :], 0.0)
        turn = np.clip(ahead.quantiles.turn * self.turn[of, None, :], -TURN_LIMIT, TURN_LIMIT)
        return replace(
            ahead,
            quantiles=Quantiles(LEVELS, np.sort(speed), np.sort(turn), self.memory),
        )


def calibrate(cases: Iterable[tuple[Traces, Traces, Traces]]) -> Calibration:
    """Find the factors from ``(forecast, past, future)`` of windows that trained nothing."""
    classes, speed, turn = [], [], []
    for ahead, past, future in cases:
        if ahead.quantiles is None:
            return Calibration.none()
        classes.append(calibration_class(past))
        away = ahead.quantiles.speed - ahead.speed[..., None]
        speed.append(_surprises(future.speed - ahead.speed, away))
        error = wrapped(future.theta_met - ahead.theta_met)
        turn.append(_surprises(error, ahead.quantiles.turn))
    of = np.concatenate(classes)
    speeds, turns = np.concatenate(speed), np.concatenate(turn)
    memory = (_memory(speeds), _memory(turns))
    return Calibration(_factors(speeds, of), _factors(turns, of), memory)


def _surprises(error: Floats, away: Floats) -> Floats:
    """Errors ``(B, H)`` over the distance of each quantile from the median, ``(B, H, Q)``."""
    least = np.copysign(1e-6, np.array(LEVELS) - 0.5)
    return error[..., None] / np.where(np.abs(away) > 1e-6, away, least)


def _factors(surprises: Floats, classes: Classes) -> Floats:
    """Quantiles of the surprises within each class, shape ``(8, Q)``."""
    factors = np.ones((CLASSES, len(LEVELS)))
    for k in range(len(factors)):
        inside = surprises[classes == k].reshape(-1, len(LEVELS))
        if len(inside) < FEW:
            continue
        for j, level in enumerate(LEVELS):
            if level != 0.5:
                p = max(level, 1 - level) * (1 + 1 / len(inside))
                factors[k, j] = np.quantile(inside[:, j], min(p, 1.0))
    return np.clip(factors, *FACTOR_LIMITS)


def _memory(surprises: Floats) -> float:
    """Fit the exponent a of the correlation (h / h')^a to errors in units of their spread."""
    B, H, _ = surprises.shape
    if H < 2 or B * H < FEW:
        return 0.5
    up, down = surprises[..., -1], -surprises[..., 0]  # each right on its own side of the median
    spread = np.clip(np.where(up > 0, up, down), -2.0, 2.0)
    correlation = np.atleast_2d(np.corrcoef(spread, rowvar=False))
    h = np.log(np.arange(1, H + 1))
    i, j = np.triu_indices(H, 1)
    exponents = -np.log(np.clip(correlation[i, j], 1e-3, 0.999)) / (h[j] - h[i])
    return float(np.median(exponents))
