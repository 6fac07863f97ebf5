"""``windopt demo``: the main job on the built-in farm, stations and wind."""

from pathlib import Path

import numpy as np
import typer

from windopt.cli import options as opt
from windopt.cli.compiling import tell_of_compiling
from windopt.cli.files import require_free, write_folder
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.summaries import show_plan
from windopt.cli.terminal import note, progress, say
from windopt.io.built_in import built_in_farm, built_in_series, built_in_stations
from windopt.planning.inspection import DEFAULT_METHOD
from windopt.planning.plan import plan

# An afternoon on which the wind is strong enough to matter and UAVs may fly.
TIME = np.datetime64("2009-01-10T14:00")
FOLDER = Path("windopt-demo")


def demo(
    method: opt.RoutingMethod = DEFAULT_METHOD,
    time_limit: opt.TimeLimit = 60.0,
    seed: opt.Seed = 0,
    json: opt.Json = False,
    out: opt.Out = FOLDER,
    force: opt.Force = False,
) -> None:
    """Plan the built-in farm Walney in a built-in wind; needs no network and no extra."""
    folder = out or FOLDER
    require_free(folder, force=force)
    farm, series = built_in_farm(), built_in_series()
    tell_of_compiling(method)
    with progress(f"Planning {farm.name} at {TIME}") as update:
        made = plan(
            farm,
            built_in_stations(),
            series,
            time=TIME,
            method=method,
            time_limit=time_limit,
            seed=seed,
            progress=update,
        )
    if json:
        print_record(made)
    else:
        note((*farm.notes, *series.notes))
        show_plan(made)
    write_folder(made, folder, force=force, series=series)
    if not json:
        say(f"Check it: windopt check {folder / 'plan.json'}")
    raise typer.Exit(exit_code(made.inspection))
