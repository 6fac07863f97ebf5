"""Backtests: how wrong forecasters were on windows they have not seen, side by side."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.conformal_persistence import ConformalPersistence
from windopt.forecasting.faults import without_faults
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.scores import Score, score
from windopt.forecasting.windows import Windows, chronological_split, steps_in, windows


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
    notes
        What was masked before.
    """

    series: str
    step: np.timedelta64
    windows: int
    scores: tuple[Score, ...]
    notes: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> Score:
        return next(score for score in self.scores if score.name == name)


def backtest(forecasters: Sequence[Forecaster], series: WindSeries) -> Backtest:
    """Score forecasters, already fitted to earlier data, on every window of ``series``.

    Parameters
    ----------
    forecasters
        All with one horizon. Windows have the longest of their histories, and each forecaster
        sees as much of it as it looks back. Persistence is added where it is not among them.

    Raises
    ------
    InvalidInput
        If their horizons differ, or ``series`` holds no window.
    """
    horizons = {f.horizon for f in forecasters} or {Persistence.horizon}
    if len(horizons) > 1:
        raise InvalidInput("forecasters", "of one horizon", sorted(map(str, horizons)))
    horizon = horizons.pop()
    history = max((f.history for f in forecasters), default=Persistence.history)
    rivals = [f for f in forecasters if f.name != Persistence.name]
    test = windows(series, history=history, horizon=horizon)
    methods: list[Forecaster] = [Persistence(history, horizon), *rivals]
    scores = tuple(_score(forecaster, test) for forecaster in methods)
    return Backtest(series.source, series.step, len(test), scores, series.notes)


def evaluate(
    forecasters: Sequence[Forecaster], series: WindSeries, *, test: float = 1 / 3
) -> Backtest:
    """Score trained forecasters on the last fraction ``test`` of a measured series.

    Faults of sensors are masked first. Beside the forecasters stand persistence, with bands of
    constant width, and linear autoregression, both fitted to what comes before the test; one that
    finds too little there is left out, and the notes say so.

    Raises
    ------
    InvalidInput
        As :func:`backtest`.
    """
    before, after = chronological_split(without_faults(series), test)
    history, horizon = (
        (forecasters[0].history, forecasters[0].horizon)
        if forecasters
        else (Persistence.history, Persistence.horizon)
    )
    windows(after, history=history, horizon=horizon)  # Without one there is nothing to score.
    rivals, notes = [], list(after.notes)
    for rival in LinearAutoregression(history, horizon), ConformalPersistence(history, horizon):
        try:
            rivals.append(rival.fit(before))
        except InvalidInput as mistake:
            notes.append(f"Without {rival.name}: expected {mistake.field} {mistake.expected}.")
    return backtest([*rivals, *forecasters], replace(after, notes=tuple(notes)))


def _score(forecaster: Forecaster, test: Windows) -> Score:
    """Errors of one forecaster over all windows."""
    step = test.series.step
    L = steps_in(forecaster.history, step, "history")
    cases = ((forecaster.forecast(block.past.last(L), step), block) for block in test.blocks())
    return score(forecaster.name, cases, test)
