"""The LSTM as a forecaster: one that learns, and one that runs a trained model without torch."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Self

import numpy as np

from windopt.domain.wind import WindForecast, WindSeries
from windopt.errors import InvalidInput, MissingExtra
from windopt.forecasting import model_file
from windopt.forecasting.averaging import averaged
from windopt.forecasting.evaluation import Backtest, backtest
from windopt.forecasting.faults import suspected
from windopt.forecasting.forecaster import issue
from windopt.forecasting.integer_network import IntegerNetwork
from windopt.forecasting.model import Model
from windopt.forecasting.network import FloatNetwork, Network, QuantisedWeights, Weights
from windopt.forecasting.sparse_network import SparseNetwork
from windopt.forecasting.windows import HISTORY, HORIZON, Traces, minutes, steps_in

if TYPE_CHECKING:
    from windopt.forecasting.training.fit import Recipe
    from windopt.forecasting.training.loop import Epoch

SHIPPED = {5: "wind-5min.npz", 10: "wind-10min.npz"}  # by step in minutes


class Arithmetic(StrEnum):
    """What a trained model computes with."""

    FLOAT = "float"
    INTEGER = "integer"
    SPARSE = "sparse"


@dataclass(frozen=True)
class EdgeForecaster:
    """A trained model, run with NumPy.

    Parameters
    ----------
    model
        What a file holds; ``None`` is the model that comes with the package, which :meth:`fit`
        chooses by the step of the series.
    arithmetic
        Floating point, or, for quantised weights, integers or sparse products.
    name
        What tables call it.
    """

    model: Model | None = None
    arithmetic: Arithmetic = Arithmetic.FLOAT
    name: str = "lstm"

    def __post_init__(self) -> None:
        in_floats = self.model is not None and isinstance(self.model.weights, Weights)
        if self.arithmetic is not Arithmetic.FLOAT and in_floats:
            raise InvalidInput("arithmetic", "float for weights in floating point", self.arithmetic)

    @classmethod
    def load(cls, path: str | Path, *, arithmetic: str = "float") -> Self:
        """Read a model's file.

        Raises
        ------
        InvalidInput
            If the file is not a whole model of this version.
        """
        return cls(model_file.load(Path(path)), Arithmetic(arithmetic))

    @classmethod
    def shipped(cls, step: np.timedelta64, *, arithmetic: str = "float") -> Self:
        """Return the 4-bit model that comes with the package for series of this ``step``.

        Raises
        ------
        InvalidInput
            If there is none: the models are for 5 and 10 minutes and for what divides these.
        """
        fitting = [name for count, name in SHIPPED.items() if not np.timedelta64(count, "m") % step]
        if not fitting:
            expected = (
                f"to divide {' or '.join(map(str, SHIPPED))} minutes; train a model for others"
            )
            raise InvalidInput("step", expected, minutes(step))
        file = resources.files("windopt.forecasting") / "models" / fitting[0]
        return cls(model_file.loads(file.read_bytes(), file.name), Arithmetic(arithmetic))

    @property
    def history(self) -> np.timedelta64:
        """How far it looks back."""
        return HISTORY if self.model is None else self.model.history

    @property
    def horizon(self) -> np.timedelta64:
        """How far it looks ahead."""
        return HORIZON if self.model is None else self.model.horizon

    @cached_property
    def network(self) -> Network:
        """The network in the arithmetic asked for."""
        model = self._chosen()
        weights = model.weights
        if isinstance(weights, QuantisedWeights) and self.arithmetic is Arithmetic.INTEGER:
            return IntegerNetwork(weights, steps_in(model.history, model.step, "history"))
        if isinstance(weights, QuantisedWeights) and self.arithmetic is Arithmetic.SPARSE:
            return SparseNetwork(weights)
        return FloatNetwork(model.float_weights)

    def fit(self, series: WindSeries) -> Self:
        """Return itself, as it has been trained, or the shipped model for this step."""
        return self if self.model else self.shipped(series.step, arithmetic=self.arithmetic)

    def forecast(self, past: Traces, step: np.timedelta64) -> Traces:
        """Return the forecast after each trace, with calibrated quantiles.

        Raises
        ------
        InvalidInput
            If the model was trained on another step.
        """
        model = self._chosen()
        if step != model.step:
            raise InvalidInput("step", f"{minutes(model.step)}, as the model's", minutes(step))
        return model.forecast(self.network, past)

    def suited(self, series: WindSeries) -> WindSeries:
        """Return ``series`` in the model's step: itself, or means where its rows come oftener.

        Raises
        ------
        InvalidInput
            If the model's step is not a multiple of the series'.
        """
        step = self._chosen().step
        if step % series.step:
            raise InvalidInput(
                "step", f"to divide the model's, {minutes(step)}", minutes(series.step)
            )
        return averaged(series, step)

    def predict(self, history: WindSeries) -> WindForecast:
        """Return the forecast after the last row of ``history``, whose step may be shorter."""
        known = self.suited(history)
        forecast = issue(self, known)
        if known is history:
            return forecast
        warnings = suspected(history, steps_in(self.history, history.step, "history"))
        notes = (*known.notes[len(history.notes) :], *warnings, *forecast.notes)
        return replace(forecast, notes=notes)

    def backtest(self, series: WindSeries) -> Backtest:
        """Score the model on every window of ``series``, beside persistence."""
        return backtest([self], self.suited(series))

    def save(self, path: str | Path) -> None:
        """Write the model's file, whole or not at all."""
        model_file.save(self._chosen(), Path(path))

    def _chosen(self) -> Model:
        if self.model is None:
            raise InvalidInput("lstm", "to be fitted first, which chooses its model", "no model")
        return self.model


@dataclass(frozen=True)
class WindForecaster:
    """The LSTM before training; :meth:`fit` trains it, and needs the extra ``train``.

    Parameters
    ----------
    recipe
        What to train; the default is the paper's network with our target at 4 bits.
    seed
        Of the initial weights and the order of the windows.
    progress
        Called after each pass over the training windows.
    checkpoint
        A file that keeps the training's state, so that one that was interrupted goes on.
    """

    recipe: "Recipe | None" = None
    seed: int = 0
    progress: "Callable[[Epoch], None] | None" = field(default=None, repr=False)
    checkpoint: Path | None = None

    def fit(self, series: WindSeries | Sequence[WindSeries]) -> EdgeForecaster:
        """Train on one series or on several of one step, masking faults of the sensors first.

        Raises
        ------
        MissingExtra
            If torch is not installed.
        InvalidInput
            If a series is too short to be split into training and validation.
        """
        try:
            from windopt.forecasting.training.fit import Recipe, fit
        except ModuleNotFoundError as missing:
            if missing.name != "torch":
                raise
            raise MissingExtra("Training", "train") from missing
        several = [series] if isinstance(series, WindSeries) else list(series)
        model = fit(
            self.recipe or Recipe(),
            several,
            seed=self.seed,
            progress=self.progress,
            checkpoint=self.checkpoint,
        )
        return EdgeForecaster(model)
