"""A backtest as plain data, for JSON and tables: m/s, and degrees on the circle."""

from math import isnan
from typing import Any

import numpy as np

from windopt.forecasting.calibration import SPEED_CLASSES
from windopt.forecasting.evaluation import Backtest
from windopt.forecasting.scores import Score

COVERAGES = {
    "coverage_50": "speed_in_50",
    "coverage_90": "speed_in_90",
    "direction_coverage_50": "direction_in_50",
    "direction_coverage_90": "direction_in_90",
}


def report(backtest: Backtest) -> dict[str, Any]:
    """Return the table: each figure the mean over the horizon, then by step and by speed.

    Pinball losses are means over the levels 5, 25, 50, 75 and 95 %; ``coverage_90`` is that of
    the speed. What a method does not give is ``None``.
    """
    minutes = backtest.step / np.timedelta64(1, "m")
    persistence = backtest.scores[0]
    return {
        "series": backtest.series,
        "step_minutes": float(minutes),
        "windows": backtest.windows,
        "notes": list(backtest.notes),
        "methods": [_method(score, persistence, float(minutes)) for score in backtest.scores],
    }


def _method(score: Score, persistence: Score, minutes: float) -> dict[str, Any]:
    speed_skill, direction_skill = score.skill(persistence)
    H = len(score.speed_mae)
    return {
        "name": score.name,
        **_figures(score),
        "speed_skill": _number(speed_skill),
        "direction_skill": _number(direction_skill),
        "normalised": _as_in_the_paper(score),
        "by_horizon": [
            {"minutes": minutes * (h + 1), **_figures(score, step=slice(h, h + 1))}
            for h in range(H)
        ],
        "by_speed": [
            {"speed": _label(k), "windows": int(count), **_figures(score, of=k)}
            for k, count in enumerate(score.windows)
        ],
    }


def _figures(
    score: Score, *, of: int | None = None, step: slice = slice(None)
) -> dict[str, float | None]:
    """Return all errors over some steps ahead and one class of speed, or all."""

    def mean(error: str) -> float:
        return float(score.mean(error, of)[step].mean())

    degree = float(np.degrees(1.0))
    return {
        "speed_mae": _number(mean("speed")),
        "speed_rmse": _number(mean("speed_square") ** 0.5),
        "direction_mae": _number(degree * mean("direction")),
        "direction_rmse": _number(degree * mean("direction_square") ** 0.5),
        "speed_pinball": _number(mean("speed_pinball")),
        "direction_pinball": _number(degree * mean("direction_pinball")),
        **{name: _number(mean(error)) for name, error in COVERAGES.items()},
    }


def _as_in_the_paper(score: Score) -> dict[str, float | None]:
    """Return errors over ranges: the speed's own, and 360 degrees on the line."""
    line = score.mean("direction_on_line").mean() / (2 * np.pi)
    line_square = score.mean("direction_on_line_square").mean() / (2 * np.pi) ** 2
    circle = score.direction_mae.mean() / (2 * np.pi)
    span = score.speed_range or float("nan")
    return {
        "speed_mae": _number(score.speed_mae.mean() / span),
        "speed_rmse": _number(score.mean("speed_square").mean() ** 0.5 / span),
        "direction_mae": _number(line),
        "direction_rmse": _number(line_square**0.5),
        "direction_mae_on_circle": _number(circle),
    }


def _label(k: int) -> str:
    """Name a class of speed."""
    edges = (0.0, *SPEED_CLASSES)
    return f"{edges[k]:g}-{edges[k + 1]:g} m/s" if k < len(SPEED_CLASSES) else f">{edges[k]:g} m/s"


def _number(value: float) -> float | None:
    return None if isnan(value) else float(value)
