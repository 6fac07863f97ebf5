"""Backtests: how wrong forecasters were on a series they have not seen, step by step.

Directions are scored on the circle: 359 and 1 degrees are 2 degrees apart. Scores hold one value
for each step ahead; their means over the horizon are what a table shows first.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from windopt.domain.wind import Floats, WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.windows import Windows, windows


def angle_between(a: Floats, b: Floats) -> Floats:
    """Return the turn from ``b`` to ``a`` on the circle [rad], in [-pi, pi)."""
    return (a - b + np.pi) % (2 * np.pi) - np.pi


@dataclass(frozen=True)
class Score:
    """Errors of one forecaster at each step ahead, shapes ``(H,)``.

    Parameters
    ----------
    speed_mae, speed_rmse
        Mean absolute and root mean square error of the wind speed [m/s].
    direction_mae, direction_rmse
        The same of the direction, on the circle [rad].
    """

    name: str
    speed_mae: Floats
    speed_rmse: Floats
    direction_mae: Floats
    direction_rmse: Floats

    def skill(self, reference: "Score") -> tuple[float, float]:
        """Fraction by which the mean errors of speed and direction lie below ``reference``'s."""
        return (
            _skill(self.speed_mae, reference.speed_mae),
            _skill(self.direction_mae, reference.direction_mae),
        )


def _skill(error: Floats, reference: Floats) -> float:
    """Skill [-]; NaN where the reference makes no error."""
    return float(1 - error.mean() / reference.mean()) if reference.any() else float("nan")


@dataclass(frozen=True)
class Backtest:
    """Forecasters side by side on the same windows, persistence first.

    Parameters
    ----------
    series
        Where the windows lie.
    step
        Time between two rows.
    windows
        How many forecasts each forecaster made.
    scores
        One for each forecaster.
    """

    series: str
    step: np.timedelta64
    windows: int
    scores: tuple[Score, ...]

    def __getitem__(self, name: str) -> Score:
        return next(score for score in self.scores if score.name == name)


def backtest(forecasters: Sequence[Forecaster], series: WindSeries) -> Backtest:
    """Score forecasters, already fitted to earlier data, on every window of ``series``.

    Parameters
    ----------
    forecasters
        All with one history and one horizon. Persistence is added where it is not among them.

    Raises
    ------
    InvalidInput
        If their histories or horizons differ, or ``series`` holds no window.
    """
    durations = {(f.history, f.horizon) for f in forecasters} or {
        (Persistence.history, Persistence.horizon)
    }
    if len(durations) > 1:
        raise InvalidInput("forecasters", "of one history and one horizon", sorted(durations))
    history, horizon = durations.pop()
    rivals = [f for f in forecasters if f.name != Persistence.name]
    test = windows(series, history=history, horizon=horizon)
    methods: list[Forecaster] = [Persistence(history, horizon), *rivals]
    scores = tuple(_score(forecaster, test) for forecaster in methods)
    return Backtest(series.source, series.step, len(test), scores)


def _score(forecaster: Forecaster, test: Windows) -> Score:
    """Errors of one forecaster over all windows."""
    sums = np.zeros((4, test.horizon))
    for block in test.blocks():
        ahead, future = forecaster.forecast(block.past, test.series.step), block.future
        speed = ahead.speed - future.speed
        turn = angle_between(ahead.theta_met, future.theta_met)
        sums += np.stack([np.abs(speed), speed**2, np.abs(turn), turn**2]).sum(axis=1)
    speed_mae, speed_mse, direction_mae, direction_mse = sums / len(test)
    return Score(
        forecaster.name, speed_mae, np.sqrt(speed_mse), direction_mae, np.sqrt(direction_mse)
    )
