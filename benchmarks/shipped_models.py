"""Train the models that come with the package, and write the card of each.

``python -m benchmarks.shipped_models 5 FILE...`` trains on measured 5-minute series, and
``python -m benchmarks.shipped_models 10`` on the 10-minute series that py_wake, brightwind and
foxes publish under the MIT licence, which must be installed. The last third of every series is left
out, and the card says how the model does on it; with ``--floats`` the same network in floating
point stands beside it.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from importlib.resources import files
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from benchmarks.forecast import trained
from windopt.domain.wind import WindSeries
from windopt.forecasting.evaluation import evaluate
from windopt.forecasting.faults import without_faults
from windopt.forecasting.lstm import SHIPPED, EdgeForecaster
from windopt.forecasting.report import report
from windopt.forecasting.training.fit import Recipe
from windopt.forecasting.training.loop import Epoch
from windopt.forecasting.windows import chronological_split

MODELS = Path(__file__).parents[1] / "windopt" / "forecasting" / "models"
TEST = 1 / 3
COLUMNS = (
    "speed_mae",
    "direction_mae",
    "speed_pinball",
    "direction_pinball",
    "coverage_90",
    "direction_coverage_90",
)

TEN_MINUTES = (
    "py_wake's year of winds, of a site and year it does not name",
    "brightwind's demonstration mast, cup and vane at 80 m",
    "foxes' month of the WRF model, 100 m",
)  # as ten_minute_series

CARD = """\
# {file}: the next 40 minutes of wind, every {step} minutes

An LSTM of {units} units with weights of 4 bits; inputs, outputs and quantiles as in
`windopt.forecasting.targets`. It sees two hours of speed and direction, and nothing of the site.

Trained on the first two thirds of

{data}

of which the last 12 % stopped the training and calibrated the quantiles. On the last thirds, which
trained nothing (means over the horizon; m/s, and degrees on the circle; persistence, with
bands of constant width, and linear autoregression fitted to the first two thirds):

| series | method | speed MAE | direction MAE | speed pinball | direction pinball | speed in 90 % \
| direction in 90 % |
|---|---|---|---|---|---|---|---|
{table}

The share of truths in the bands of 90 %, by the speed last measured, with the number of windows:

| series | of | {classes} |
|---|---|{rules}
{shares}

Made {date} by `{command}`.
"""


def ten_minute_series() -> list[WindSeries]:
    """Return the series that packages under the MIT licence publish."""
    return [py_wake_series(), brightwind_series(), built_in_series()]


def py_wake_series() -> WindSeries:
    """Return py_wake's year of 10-minute means; it names neither site nor year."""
    path = Path(str(files("py_wake") / "examples/data/time_series.npz"))
    with np.load(path, allow_pickle=False) as arrays:
        speed, direction = arrays["ws"].astype(float), arrays["wd"].astype(float)
    time = np.datetime64("2001-01-01T00:00") + np.timedelta64(10, "m") * np.arange(len(speed))
    return WindSeries(time, speed, np.radians(direction % 360), source="py_wake, time_series.npz")


def brightwind_series() -> WindSeries:
    """Return brightwind's demonstration mast, 80 m."""
    path = Path(str(files("brightwind") / "demo_datasets/demo_data.csv"))
    return WindSeries.read(path, time="Timestamp", speed="Spd80mN", direction="Dir78mS")


def built_in_series() -> WindSeries:
    """Return the month of WRF that comes with windopt, from foxes."""
    return WindSeries.read(Path(str(files("windopt") / "data/wrf-2009-01.csv.gz")))


def ship(
    model: EdgeForecaster,
    rivals: Sequence[EdgeForecaster],
    series: Sequence[WindSeries],
    about: Sequence[str],
    command: str,
) -> None:
    """Write the model and its card, in which each series is called what ``about`` says."""
    minutes = int(series[0].step / np.timedelta64(1, "m"))
    path = MODELS / SHIPPED[minutes]
    model.save(path)
    tested = EdgeForecaster.load(path)
    names = [one.split(",")[0] for one in about]
    reports = [report(evaluate([*rivals, tested], one, test=TEST)) for one in series]
    classes = [one["speed"] for one in reports[0]["methods"][-1]["by_speed"]]
    card = CARD.format(
        file=path.name,
        step=minutes,
        units=tested.model.units if tested.model else 0,
        data="\n".join(map(_described, about, series)),
        table="\n".join(chain.from_iterable(map(_errors, names, reports))),
        classes=" | ".join(classes),
        rules="---|" * len(classes),
        shares="\n".join(chain.from_iterable(map(_shares, names, reports))),
        date=datetime.now(UTC).date().isoformat(),
        command=command,
    )
    path.with_suffix(".md").write_text(card, encoding="utf-8")


def _described(about: str, series: WindSeries) -> str:
    """Name a series with its period and its gaps, as in a list."""
    known = without_faults(series).valid.mean()
    first, last = (np.datetime_as_string(time, unit="D") for time in series.time[[0, -1]])
    return f"- {about}: {first} to {last}, {known:.1%} of {len(series)} rows valid"


def _errors(name: str, found: dict[str, Any]) -> Iterator[str]:
    """Yield the rows of the card's table of errors on one series."""
    for method in found["methods"]:
        values = ("-" if method[key] is None else f"{method[key]:.3f}" for key in COLUMNS)
        yield f"| {name} | {method['name']} | {' | '.join(values)} |"


def _shares(name: str, found: dict[str, Any]) -> Iterator[str]:
    """Yield the rows of the card's table of bands on one series; the model comes last."""
    for what, key in ("speed", "coverage_90"), ("direction", "direction_coverage_90"):
        classes = found["methods"][-1]["by_speed"]
        cells = (
            f"{one[key]:.3f} ({one['windows']})" if one["windows"] else "- (0)" for one in classes
        )
        yield f"| {name} | {what} | {' | '.join(cells)} |"


def main() -> None:
    """Train and write."""
    parser = argparse.ArgumentParser(description="Train the models that come with the package.")
    parser.add_argument("step", type=int, choices=SHIPPED, help="minutes between two rows")
    parser.add_argument("files", type=Path, nargs="*", help="measured series of this step")
    parser.add_argument("--about", nargs="*", help="what the card calls each of them")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--floats", action="store_true", help="put 32 bits beside it in the card")
    chosen = parser.parse_args()
    series = [WindSeries.read(path) for path in chosen.files] or ten_minute_series()

    def progress(epoch: Epoch) -> None:
        losses = f"{epoch.loss:.4f}  {epoch.validation_loss:.4f}"
        print(f"{epoch.bits:2d} bits {epoch.number:3d}  {losses}", flush=True)

    early = [chronological_split(one, TEST)[0] for one in series]
    with TemporaryDirectory() as kept:
        learn = partial(trained, series=early, seed=chosen.seed, folder=Path(kept))
        model = learn(Recipe(), progress=progress)
        floats = [learn(Recipe(bits=32))] if chosen.floats else []
    rivals = [replace(one, name="lstm, 32 bits") for one in floats]
    names = [path.name for path in chosen.files]
    about = (chosen.about or names) if names else TEN_MINUTES
    words = ["python -m benchmarks.shipped_models", str(chosen.step), *names]
    ship(model, rivals, series, about, " ".join(words + ["--floats"] * chosen.floats))


if __name__ == "__main__":
    main()
