"""Persistence with bands of constant width: the least that a probabilistic forecast must beat."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from windopt.domain.quantiles import Quantiles
from windopt.domain.wind import Floats, WindForecast, WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.forecaster import issue
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.targets import LEVELS, wrapped
from windopt.forecasting.windows import HISTORY, HORIZON, Traces, windows


@dataclass(frozen=True)
class ConformalPersistence:
    """The last wind, give or take what it usually changes in so many steps.

    Parameters
    ----------
    history, horizon
        How far it looks back and ahead.
    speed, turn
        Quantiles of the changes, shape ``(H, Q)``, which :meth:`fit` finds.
    step
        Time between the rows it was fitted to.
    """

    history: np.timedelta64 = HISTORY
    horizon: np.timedelta64 = HORIZON
    speed: Floats | None = None
    turn: Floats | None = None
    step: np.timedelta64 | None = None
    name: str = "conformal persistence"

    def fit(self, series: WindSeries) -> Self:
        """Return this forecaster with the quantiles of the changes in ``series``."""
        found = windows(series, history=self.history, horizon=self.horizon)
        past, future = found.past, found.future
        change = future.speed - past.speed[:, -1:]
        turn = wrapped(future.theta_met - past.theta_met[:, -1:])
        return replace(
            self,
            speed=np.quantile(change, LEVELS, axis=0).T,
            turn=np.quantile(turn, LEVELS, axis=0).T,
            step=series.step,
        )

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return the last wind of each trace with the same bands around each.

        Raises
        ------
        InvalidInput
            If it has not been fitted, or was to a series of another step.
        """
        if self.speed is None or self.turn is None:
            raise InvalidInput("conformal persistence", "to be fitted first", "no quantiles")
        if step != self.step:
            raise InvalidInput("step", f"{self.step}, as in the series it was fitted to", step)
        ahead = Persistence(self.history, self.horizon).forecast(past, step)
        speed = np.maximum(ahead.speed[..., None] + self.speed, 0.0)
        turn = np.broadcast_to(self.turn, speed.shape)
        return replace(ahead, quantiles=Quantiles(LEVELS, speed, turn))

    def predict(self, history: WindSeries) -> WindForecast:
        """Return the last wind of ``history`` with its bands."""
        return issue(self, history)
