"""``windopt forecast``: train a quantised LSTM, ask it, and score it beside baselines."""

import json as json_text
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.table import Table

from windopt.cli import options as opt
from windopt.cli.checked import at_least, checked, within
from windopt.cli.terminal import err, note, out, say
from windopt.cli.times import parsed
from windopt.domain.wind import WindForecast, WindSeries
from windopt.errors import InvalidInput, MissingExtra
from windopt.forecasting.evaluation import evaluate as score
from windopt.forecasting.faults import without_faults
from windopt.forecasting.lstm import EdgeForecaster, WindForecaster
from windopt.forecasting.report import report
from windopt.forecasting.windows import chronological_split

if TYPE_CHECKING:
    from windopt.forecasting.training.loop import Epoch

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None)

SHIPPED = "shipped"
TEST = 1 / 3

SeriesFile = Annotated[
    Path, typer.Argument(metavar="SERIES", help="CSV with time, speed and direction.")
]
SeriesFiles = Annotated[
    list[Path], typer.Argument(metavar="SERIES...", help="As many CSV files, of one step.")
]
ModelFile = Annotated[
    str, typer.Argument(metavar="MODEL", help=f"A model's file, or {SHIPPED} for windopt's own.")
]
Bits = Annotated[int, typer.Option(help="Bits of a weight: 32, 16, 8, 4 or 2.")]
OutputBits = Annotated[int | None, typer.Option(help="Bits of the output layer; as --bits.")]
Units = Annotated[int, typer.Option(callback=checked(at_least(1)), help="Hidden units.")]
TargetName = Annotated[str, typer.Option(help="residual on persistence, or raw as in the paper.")]
Minutes = Annotated[
    int,
    typer.Option(
        callback=checked(at_least(1)), help="How far to look, a multiple of the step [min]."
    ),
]
Epochs = Annotated[
    int,
    typer.Option(callback=checked(at_least(1)), help="Passes over the training windows at most."),
]
Holdout = Annotated[
    float,
    typer.Option(
        callback=checked(within(0.0, 0.9)),
        help="Last fraction of each that evaluate tests on, 0.9 at most.",
    ),
]
NewModel = Annotated[Path, typer.Option("--out", help="Where the trained model goes.")]
Checkpoint = Annotated[
    Path | None, typer.Option(help="Keeps the state, so that an interrupted training goes on.")
]


@app.command()
def train(
    series: SeriesFiles,
    model: NewModel,
    bits: Bits = 4,
    output_bits: OutputBits = None,
    units: Units = 100,
    target: TargetName = "residual",
    history: Minutes = 120,
    horizon: Minutes = 40,
    epochs: Epochs = 24,
    holdout: Holdout = TEST,
    checkpoint: Checkpoint = None,
    time_column: opt.Column = "",
    speed_column: opt.Column = "",
    direction_column: opt.Column = "",
    seed: opt.Seed = 0,
    force: opt.Force = False,
) -> None:
    """Train an LSTM on measured series; needs the extra train."""
    if model.exists() and not force:
        raise InvalidInput("--out", "to be a new file, or --force", model)
    columns = {"time": time_column, "speed": speed_column, "direction": direction_column}
    measured = [WindSeries.read(path, **columns) for path in series]
    for one in measured:
        note((*one.notes, *without_faults(one).notes[len(one.notes) :]))
    early = [chronological_split(one, holdout)[0] if holdout else one for one in measured]
    recipe = _recipe(
        bits=bits,
        output_bits=output_bits,
        units=units,
        target=target,
        history=np.timedelta64(history, "m"),
        horizon=np.timedelta64(horizon, "m"),
        epochs=epochs,
    )
    names = ", ".join(path.name for path in series)
    with _epochs(f"Training {bits} bits on {names}", epochs) as update:
        forecaster = WindForecaster(recipe, seed=seed, progress=update, checkpoint=checkpoint)
        trained = forecaster.fit(early)
    trained.save(model)
    say(f"Written to {model}: {model.stat().st_size} bytes.")
    for path in series:
        say(f"Score it: windopt forecast evaluate {model} {path}")


@app.command()
def predict(
    model: ModelFile,
    series: SeriesFile,
    time: opt.Time = None,
    time_column: opt.Column = "",
    speed_column: opt.Column = "",
    direction_column: opt.Column = "",
    json: opt.Json = False,
) -> None:
    """Forecast what follows a time of a measured series: the next 40 minutes, if shipped."""
    measured = WindSeries.read(
        series, time=time_column, speed=speed_column, direction=direction_column
    )
    at = parsed(time)
    known = measured if at is None else measured.until(at)
    forecast = _model(model, measured).predict(known)
    if json:
        typer.echo(json_text.dumps(_record(forecast), indent=2, allow_nan=False))
        return
    note((*measured.notes, *forecast.notes))
    table = Table("time", "m/s", "90 % within", "deg", "90 % within", title=forecast.method)
    for step in _record(forecast)["steps"]:
        table.add_row(
            step["time"],
            f"{step['wind_speed']:.2f}",
            _band(step, "speed_quantiles", 2),
            f"{step['wind_direction']:.1f}",
            _band(step, "direction_quantiles", 1),
        )
    out.print(table)


@app.command()
def evaluate(
    model: ModelFile,
    series: SeriesFile,
    test: Annotated[
        float,
        typer.Option(
            callback=checked(within(0.01, 0.99)),
            help="Last fraction to test on, from 0.01 to 0.99.",
        ),
    ] = TEST,
    time_column: opt.Column = "",
    speed_column: opt.Column = "",
    direction_column: opt.Column = "",
    json: opt.Json = False,
) -> None:
    """Score a model beside persistence and linear autoregression on the end of a series."""
    measured = WindSeries.read(
        series, time=time_column, speed=speed_column, direction=direction_column
    )
    forecaster = _model(model, measured)
    backtest = score([forecaster], forecaster.suited(without_faults(measured)), test=test)
    found = report(backtest)
    if json:
        typer.echo(json_text.dumps(found, indent=2, allow_nan=False))
        return
    note(backtest.notes)
    say(f"{found['series']}: {found['windows']} windows, every {found['step_minutes']:g} min")
    for what, unit, columns in TABLES:
        table = Table(what, *(heading for heading, _ in columns), title=f"{what} ({unit})")
        for method in found["methods"]:
            figures = (method[key] for _, key in columns)
            table.add_row(method["name"], *("-" if f is None else f"{f:.3f}" for f in figures))
        out.print(table)


def _band(step: dict[str, Any], quantiles: str, decimals: int) -> str:
    """Print the outermost quantiles of a step, where the model gives them."""
    if quantiles not in step:
        return "-"
    low, *_, high = step[quantiles]
    return f"{low:.{decimals}f} to {high:.{decimals}f}"


TABLES = (
    (
        "speed",
        "m/s, means over the horizon",
        (
            ("MAE", "speed_mae"),
            ("RMSE", "speed_rmse"),
            ("skill of MAE", "speed_skill"),
            ("pinball", "speed_pinball"),
            ("in 50 %", "coverage_50"),
            ("in 90 %", "coverage_90"),
        ),
    ),
    (
        "direction",
        "degrees on the circle",
        (
            ("MAE", "direction_mae"),
            ("RMSE", "direction_rmse"),
            ("skill of MAE", "direction_skill"),
            ("pinball", "direction_pinball"),
            ("in 50 %", "direction_coverage_50"),
            ("in 90 %", "direction_coverage_90"),
        ),
    ),
)  # what, its unit, and each column's heading and key; bands of 50 and 90 % hold the truth


def _model(name: str, series: WindSeries) -> EdgeForecaster:
    if name == SHIPPED:
        return EdgeForecaster.shipped(series.step)
    return EdgeForecaster.load(name)


def _recipe(*, epochs: int, **chosen: Any) -> Any:
    """Return what to train; importing it needs torch."""
    try:
        from windopt.forecasting.training.fit import Recipe
        from windopt.forecasting.training.loop import Schedule
    except ModuleNotFoundError as missing:
        raise MissingExtra("Training", "train") from missing
    return Recipe(**chosen, schedule=Schedule(epochs=epochs))


@contextmanager
def _epochs(task: str, epochs: int) -> Iterator["Callable[[Epoch], None]"]:
    """Show the passes of a training while it runs; silent off a terminal."""
    if not err.is_terminal:
        yield lambda epoch: None
        return
    with err.status(task) as status:

        def update(epoch: "Epoch") -> None:
            losses = f"loss {epoch.loss:.4f}, validation {epoch.validation_loss:.4f}"
            status.update(f"{task}: pass {epoch.number} of {epochs}, {losses}")

        yield update


def _record(forecast: WindForecast) -> dict[str, Any]:
    """Return a forecast as plain data: m/s, and degrees clockwise from north."""
    steps = []
    for h, time in enumerate(forecast.time):
        step = {
            "time": str(time),
            "wind_speed": float(forecast.speed[h]),
            "wind_direction": degrees(forecast.theta_met[h]),
        }
        if forecast.quantiles is not None:
            turned = forecast.theta_met[h] + forecast.quantiles.turn[h]
            step["speed_quantiles"] = forecast.quantiles.speed[h].tolist()
            step["direction_quantiles"] = (np.degrees(turned) % 360).tolist()
        steps.append(step)
    levels = None if forecast.quantiles is None else list(forecast.quantiles.levels)
    return {
        "issued": str(forecast.issued),
        "method": forecast.method,
        "notes": list(forecast.notes),
        "levels": levels,
        "steps": steps,
    }
