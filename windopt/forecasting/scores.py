"""Scores: errors of one forecaster, kept for each class of speed and each step ahead.

Directions are scored on the circle: 359 and 1 degrees are 2 degrees apart. The paper scores them on
the line, as fractions of 360 degrees; that figure is kept too, under its own name.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import Floats
from windopt.forecasting.calibration import SPEED_CLASSES, speed_class
from windopt.forecasting.targets import wrapped
from windopt.forecasting.windows import Traces, Windows

CLASSES = len(SPEED_CLASSES) + 1


@dataclass(frozen=True)
class Score:
    """Errors of one forecaster.

    Parameters
    ----------
    name
        Of the forecaster.
    windows
        Forecasts in each class of the last measured speed, shape ``(C,)``.
    sums
        Sums over the windows of what :func:`errors` returns, each of shape ``(C, H)``.
    speed_range
        Largest less smallest speed, by which the paper divides [m/s].
    """

    name: str
    windows: NDArray[np.intp]
    sums: dict[str, Floats]
    speed_range: float

    def mean(self, error: str, of: int | None = None) -> Floats:
        """Mean of an error at each step ahead, shape ``(H,)``, in one class of speed or in all.

        NaN where the forecaster gives no quantiles, or no window lies in the class.
        """
        if error not in self.sums:
            return np.full_like(self.sums["speed"][0], np.nan)
        rows = slice(None) if of is None else slice(of, of + 1)
        count = self.windows[rows].sum()
        total: Floats = self.sums[error][rows].sum(axis=0)
        return total / count if count else np.full_like(total, np.nan)

    @property
    def speed_mae(self) -> Floats:
        """Mean absolute error of the speed [m/s], shape ``(H,)``."""
        return self.mean("speed")

    @property
    def speed_rmse(self) -> Floats:
        """Root mean square error of the speed [m/s], shape ``(H,)``."""
        return np.sqrt(self.mean("speed_square"))

    @property
    def direction_mae(self) -> Floats:
        """Mean absolute error of the direction on the circle [rad], shape ``(H,)``."""
        return self.mean("direction")

    @property
    def direction_rmse(self) -> Floats:
        """Root mean square error of the direction on the circle [rad], shape ``(H,)``."""
        return np.sqrt(self.mean("direction_square"))

    def skill(self, reference: "Score") -> tuple[float, float]:
        """Fraction by which the mean errors of speed and direction lie below ``reference``'s."""
        return (
            _skill(self.speed_mae, reference.speed_mae),
            _skill(self.direction_mae, reference.direction_mae),
        )


def _skill(error: Floats, reference: Floats) -> float:
    """Skill [-]; NaN where the reference makes no error."""
    return float(1 - error.mean() / reference.mean()) if reference.any() else float("nan")


def score(name: str, cases: Iterable[tuple[Traces, Windows]], test: Windows) -> Score:
    """Sum the errors of forecasts over blocks of windows."""
    windows = np.zeros(CLASSES, dtype=np.intp)
    sums: dict[str, Floats] = {}
    for ahead, block in cases:
        of = speed_class(block.past)
        windows += np.bincount(of, minlength=CLASSES)
        for error, values in errors(ahead, block.future).items():
            total = sums.setdefault(error, np.zeros((CLASSES, values.shape[1])))
            np.add.at(total, of, values)
    speed = test.series.speed
    return Score(name, windows, sums, float(np.nanmax(speed) - np.nanmin(speed)))


def errors(ahead: Traces, future: Traces) -> dict[str, Floats]:
    """Return the errors of each forecast at each step, shapes ``(B, H)``.

    Of the speed [m/s] and the direction on the circle [rad], absolute and squared; of the
    direction on the line; pinball losses, and whether bands of 50 and 90 % hold the truth.
    """
    speed = future.speed - ahead.speed
    turn = wrapped(future.theta_met - ahead.theta_met)
    line = future.theta_met % (2 * np.pi) - ahead.theta_met % (2 * np.pi)
    found = {
        "speed": np.abs(speed),
        "speed_square": speed**2,
        "direction": np.abs(turn),
        "direction_square": turn**2,
        "direction_on_line": np.abs(line),
        "direction_on_line_square": line**2,
    }
    if ahead.quantiles is not None:
        found |= _quantile_errors(ahead.quantiles, future.speed, turn)
    return found


def _quantile_errors(quantiles: Quantiles, speed: Floats, turn: Floats) -> dict[str, Floats]:
    """Pinball losses, and bands between the outermost and between the middle quantiles."""
    levels, found = np.array(quantiles.levels), {}
    for name, truth, values in (
        ("speed", speed, quantiles.speed),
        ("direction", turn, quantiles.turn),
    ):
        excess = truth[..., None] - values
        loss = np.maximum(levels * excess, (levels - 1) * excess)
        found[f"{name}_pinball"] = loss.mean(axis=-1)
        for band, k in (("50", 1), ("90", 0)):
            inside = (truth >= values[..., k]) & (truth <= values[..., -1 - k])
            found[f"{name}_in_{band}"] = inside.astype(float)
    return found
