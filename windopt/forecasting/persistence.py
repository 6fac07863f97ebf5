"""Persistence: the wind stays as it was last measured. Every table carries it."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from windopt.domain.wind import WindForecast, WindSeries
from windopt.forecasting.forecaster import issue
from windopt.forecasting.windows import HISTORY, HORIZON, Traces, steps_in


@dataclass(frozen=True)
class Persistence:
    """The forecast that nothing changes.

    Parameters
    ----------
    history, horizon
        How far it looks back and ahead.
    """

    history: np.timedelta64 = HISTORY
    horizon: np.timedelta64 = HORIZON
    name: str = "persistence"

    def fit(self, series: WindSeries) -> Self:
        """Return itself: there is nothing to learn."""
        return self

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return the last wind of each trace at every step ahead."""
        H = steps_in(self.horizon, step, "horizon")
        return Traces(
            np.repeat(past.speed[:, -1:], H, axis=1), np.repeat(past.theta_met[:, -1:], H, axis=1)
        )

    def predict(self, history: WindSeries) -> WindForecast:
        """Return the last wind of ``history`` at every step ahead."""
        return issue(self, history)
