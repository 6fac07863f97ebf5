"""Forecasts of the wind as cases: the networks by bits, and what they must be better than.

Every method forecasts the last third of a series, each on the same windows of 12 hours, of which
those that look at each step use the last two. The first two thirds are there to train on.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.case import Case, Problem, Record
from benchmarks.forecast import HALF_DAY, HOURLY, MONTH, trained
from benchmarks.processor import processor_time
from windopt.domain.wind import WindSeries
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.averaging import averaged
from windopt.forecasting.conformal_persistence import ConformalPersistence
from windopt.forecasting.evaluation import backtest
from windopt.forecasting.faults import without_faults
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.hour_ahead import HOUR, HourAhead
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.model_file import dumps
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.report import report
from windopt.forecasting.training.fit import Recipe
from windopt.forecasting.windows import chronological_split

Train = Callable[[WindSeries, int, Path], Forecaster]

SERIES = {"wrf-2009-01": MONTH}
"""Series by name; this one comes with windopt."""

BITS = 32, 16, 8, 4, 2


def _recipe(recipe: Recipe) -> Train:
    return lambda series, seed, folder: trained(recipe, [series], seed, folder)


def _hourly_lstm(series: WindSeries, seed: int, folder: Path) -> Forecaster:
    return HourAhead(trained(HOURLY, [averaged(series, HOUR)], seed, folder))


METHODS: Mapping[str, Train] = {
    "persistence": lambda series, seed, folder: ConformalPersistence().fit(series),
    "autoregression": lambda series, seed, folder: LinearAutoregression().fit(series),
    **{f"lstm-{bits}": _recipe(Recipe(bits=bits)) for bits in BITS},
    **{f"lstm-raw-{bits}": _recipe(Recipe(bits=bits, target="raw")) for bits in BITS},
    "hour-ahead-persistence": lambda series, seed, folder: HourAhead(Persistence(2 * HOUR, HOUR)),
    "hour-ahead-autoregression": lambda series, seed, folder: HourAhead(
        LinearAutoregression(HALF_DAY, HOUR)
    ).fit(series),
    "hour-ahead-lstm": _hourly_lstm,
}
"""How each forecaster is made of the first two thirds, a seed and a folder to keep work in."""

SMALL = (
    "persistence",
    "autoregression",
    "lstm-32",
    "lstm-4",
    "hour-ahead-persistence",
    "hour-ahead-autoregression",
)


LIMITS = {"small": 1200.0, "medium": 1200.0, "full": 1200.0}
"""Seconds that training may take; it has no limit of its own."""


def measure(case: Case) -> Record:
    """Train a forecaster, and score it; errors are of all steps ahead together."""
    before, after = chronological_split(without_faults(_series(case.instance)), 1 / 3)
    began = processor_time()
    with TemporaryDirectory() as folder:
        forecaster = METHODS[case.method](before, case.seed, Path(folder))
    spent = processor_time() - began
    windows_of_12_h = HourAhead(Persistence(2 * HOUR, HOUR))
    scores = report(backtest([windows_of_12_h, forecaster], after))["methods"][-1]
    model = forecaster.model if isinstance(forecaster, EdgeForecaster) else None
    return {
        "status": "scored",
        "speed_mae": scores["speed_mae"],
        "direction_mae": scores["direction_mae"],
        "normalised": scores["normalised"],
        "bytes": len(dumps(model)) if model else None,
        "cpu": round(spent, 3),
    }


def _series(name: str) -> WindSeries:
    return WindSeries.read(SERIES.get(name, name))


PROBLEM = Problem(
    instances=lambda chosen: tuple(SERIES) if chosen in LIMITS else (),
    methods=lambda chosen: SMALL if chosen == "small" else tuple(METHODS),
    time_limits=LIMITS,
    measure=measure,
)
