r"""Linear autoregression: least squares of each step ahead on the whole history.

The wind is written as z = (u, v, s), its velocity and its speed: a mean of velocities is shorter
than the mean of their lengths, so the speed has a head of its own. What is forecast is the change
since the last measurement, which makes persistence the forecast of zero weights:

.. math::

    \hat z_{t+h} = z_t + x A_h, \quad x = (1, z_{t-L+1}, \dots, z_t), \qquad
    A = (X^\top X + \rho \operatorname{diag} X^\top X)^{-1} X^\top Y

with one row of X and of the changes Y for each window. The ridge :math:`\rho` only keeps the
system solvable where histories are collinear, as in a series that hardly changes.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from windopt.domain.wind import Floats, WindForecast, WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.forecaster import issue
from windopt.forecasting.windows import HISTORY, HORIZON, Traces, why, windows


@dataclass(frozen=True)
class LinearAutoregression:
    """Linear in the history, one equation for each step ahead.

    Parameters
    ----------
    history, horizon
        How far it looks back and ahead.
    ridge
        Rho, relative to the spread of each regressor [-].
    A
        What :meth:`fit` found, shape ``(3 L + 1, 3 H)``; ``None`` before.
    step
        Time between the rows that it was fitted to.
    """

    history: np.timedelta64 = HISTORY
    horizon: np.timedelta64 = HORIZON
    ridge: float = 1e-6
    A: Floats | None = None
    step: np.timedelta64 | None = None
    name: str = "linear autoregression"

    def fit(self, series: WindSeries) -> Self:
        """Return this forecaster, fitted to every window of ``series`` without a gap.

        Raises
        ------
        InvalidInput
            If ``series`` holds fewer windows than twice the coefficients of an equation, or its
            step does not divide the durations.
        """
        train = windows(series, history=self.history, horizon=self.horizon)
        least = 2 * (3 * train.history + 1)
        if len(train) < least:
            found = f"{len(train)} {why(series)}".strip()
            raise InvalidInput("wind series", f"to hold {least} windows to fit", found)
        XX = np.zeros((3 * train.history + 1, 3 * train.history + 1))
        XY = np.zeros((3 * train.history + 1, 3 * train.horizon))
        for block in train.blocks():
            X = _regressors(block.past)
            change = _state(block.future) - _state(block.past)[:, -1:]
            XX += X.T @ X
            XY += X.T @ change.reshape(len(block), -1)
        return replace(self, A=_ridge(XX, XY, self.ridge), step=series.step)

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return the linear forecast after each trace.

        Raises
        ------
        InvalidInput
            If it has not been fitted, or was to a series of another step.
        """
        if self.A is None:
            raise InvalidInput("linear autoregression", "to be fitted first", "no coefficients")
        if step != self.step:
            raise InvalidInput("step", f"{self.step}, as in the series it was fitted to", step)
        change = (_regressors(past) @ self.A).reshape(len(past), -1, 3)
        u, v, s = np.moveaxis(_state(past)[:, -1:] + change, -1, 0)
        return Traces(np.maximum(s, 0.0), np.arctan2(-u, -v) % (2 * np.pi))

    def predict(self, history: WindSeries) -> WindForecast:
        """Return the linear forecast after the last row of ``history``."""
        return issue(self, history)


def _state(traces: Traces) -> Floats:
    """Z = (u, v, s), shape ``(B, n, 3)``."""
    return np.concatenate([traces.velocity, traces.speed[..., None]], axis=-1)


def _regressors(past: Traces) -> Floats:
    """1 and the history of z, shape ``(B, 3 L + 1)``."""
    z = _state(past).reshape(len(past), -1)
    return np.concatenate([np.ones((len(past), 1)), z], axis=1)


def _ridge(XX: Floats, XY: Floats, rho: float) -> Floats:
    """Solve the normal equations in regressors scaled to unit length."""
    length = np.sqrt(np.diag(XX))
    length[length == 0] = 1.0
    factor = cho_factor(XX / np.outer(length, length) + rho * np.eye(len(XX)))
    A: Floats = cho_solve(factor, XY / length[:, None]) / length[:, None]
    return A
