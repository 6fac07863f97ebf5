"""The paper's two tables of forecast errors, on another series, with persistence beside them.

``python -m benchmarks.forecast [FILE] [--bits 32 4] [--seeds 0 1 2] [--no-rivals]`` trains on
the first two thirds of a 5- or 10-minute series, the built-in month unless given, and scores the
last third; ``--out FILE.csv`` keeps the tables. The paper's data set is not public; the series is
another, so the figures stand beside the paper's and do not reproduce them.

The first table compares bit widths, of our target and of the paper's own, and small networks in
floating point. The second compares forecasts from every step, the paper's remote sensing, with
forecasts from one-hour means, its hour ahead, on the same truth.
"""

import argparse
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks import edge
from benchmarks.csv_table import tabulate
from windopt.domain.wind import WindSeries
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.averaging import averaged
from windopt.forecasting.evaluation import Backtest, backtest, evaluate
from windopt.forecasting.faults import without_faults
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.hour_ahead import HOUR, HourAhead
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.model_file import dumps
from windopt.forecasting.persistence import Persistence
from windopt.forecasting.report import report
from windopt.forecasting.training.fit import Recipe, fit
from windopt.forecasting.training.loop import Epoch, Schedule
from windopt.forecasting.windows import chronological_split
from windopt.io.built_in import DATA

MONTH = DATA / "wrf-2009-01.csv.gz"
PAPER = {
    "32 bits": (0.0403, 0.0573, 0.0596, 0.1151),
    "16 bits": (0.0396, 0.0554, 0.0609, 0.1192),
    "8 bits": (0.0392, 0.0579, 0.0608, 0.1191),
    "4 bits": (0.0401, 0.0571, 0.0598, 0.1183),
    "2 bits": (0.0431, 0.0614, 0.0807, 0.1308),
    "hour ahead": (0.0719, 0.0972, 0.1051, 0.1687),
}  # speed MAE and RMSE, direction MAE and RMSE, all normalised
HEADER = (
    "method",
    "seed",
    "speed MAE m/s",
    "direction MAE deg",
    "speed MAE / range",
    "speed RMSE / range",
    "direction MAE / 360 deg",
    "direction RMSE / 360 deg",
    "bytes",
)
HALF_DAY = 12 * HOUR
QUICK = Schedule(epochs=40, batch=64), Schedule(epochs=12, batch=64, rate=1.5e-3)
HOURLY = Recipe(history=HALF_DAY, horizon=HOUR, stride=1, schedule=QUICK[0], refinement=QUICK[1])
Row = tuple[Any, ...]


def rows(table: Backtest, seed: int | str = "", size: int | str = "") -> Iterator[Row]:
    """Yield a row for each method of a backtest but those without a seed, if a seed is given."""
    methods = report(table)["methods"]
    for method in methods[-1:] if seed != "" else methods:
        paper = method["normalised"]
        figures = [
            method["speed_mae"],
            method["direction_mae"],
            *(
                paper[f"{what}_{error}"]
                for what in ("speed", "direction")
                for error in ("mae", "rmse")
            ),
        ]
        yield (method["name"], seed, *(f"{figure:.4f}" for figure in figures), size)


def recipes(bits: list[int], *, rivals: bool) -> Iterator[tuple[str, Recipe]]:
    """Yield what is compared in the first table, with or without what else may be trained."""
    for width in bits:
        yield f"lstm, {width} bits", Recipe(bits=width)
    if not rivals:
        return
    for width in bits:
        yield f"lstm, the paper's target, {width} bits", Recipe(bits=width, target="raw")
    for units in 50, 25, 16:
        yield f"lstm, {units} units, 32 bits", Recipe(bits=32, units=units)


def trained(
    recipe: Recipe,
    series: Sequence[WindSeries],
    seed: int,
    folder: Path,
    progress: Callable[[Epoch], None] | None = None,
) -> EdgeForecaster:
    """Train once: bit widths share the training in floats, and the same again is read back."""
    network = f"{recipe.target}-{recipe.units}-{recipe.history}-{seed}"
    checkpoint = folder / f"{network}.{recipe.bits}"
    model = fit(recipe, series, seed=seed, checkpoint=checkpoint, progress=progress)
    return EdgeForecaster(model)


def by_recipe(
    series: WindSeries, compared: Iterable[tuple[str, Recipe]], seeds: list[int], folder: Path
) -> Iterator[Row]:
    """Yield the rows of the first table."""
    before, after = chronological_split(without_faults(series), 1 / 3)
    yield from rows(evaluate([], series, test=1 / 3))
    for name, recipe in compared:
        for seed in seeds:
            forecaster = replace(trained(recipe, [before], seed, folder), name=name)
            size = len(dumps(forecaster.model)) if forecaster.model else ""
            yield from rows(backtest([forecaster], after), seed, size)


def by_source(series: WindSeries, folder: Path) -> Iterator[Row]:
    """Yield the rows of the second table: the same methods on each source, on the same windows."""
    before, after = chronological_split(without_faults(series), 1 / 3)
    lstm = trained(HOURLY, [averaged(before, HOUR)], 0, folder)
    forecasters: list[Forecaster] = [
        HourAhead(Persistence(2 * HOUR, HOUR)),
        HourAhead(LinearAutoregression(HALF_DAY, HOUR)).fit(before),
        HourAhead(lstm),
        LinearAutoregression().fit(before),
        trained(Recipe(), [before], 0, folder),
    ]
    for name, *figures in rows(backtest(forecasters, after)):
        yield (f"{name} (windows of 12 h)", *figures)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the tables, and write them."""
    parser = argparse.ArgumentParser(description="Errors by bit width and by source of the wind.")
    parser.add_argument("file", type=Path, nargs="?", default=MONTH, help="a measured series")
    parser.add_argument("--bits", type=int, nargs="+", default=[32, 16, 8, 4, 2])
    parser.add_argument("--seeds", type=int, nargs="+", default=[0])
    parser.add_argument(
        "--rivals",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="train the paper's own target and small networks too",
    )
    parser.add_argument("--out", type=Path, help="a CSV file for the tables, beside printing them")
    chosen = parser.parse_args(arguments)
    series = WindSeries.read(chosen.file)
    print(f"The paper's data set is not public; {series.source or chosen.file} is another.")
    published = [(f"the paper's data: {name}", "", "", "", *of, "") for name, of in PAPER.items()]
    with TemporaryDirectory() as kept:
        folder = Path(kept)
        compared = recipes(chosen.bits, rivals=chosen.rivals)
        tables = by_recipe(series, compared, chosen.seeds, folder), by_source(series, folder)
        tabulate(chain([HEADER], published, *tables), chosen.out)
    edge.main([])


if __name__ == "__main__":
    main()
