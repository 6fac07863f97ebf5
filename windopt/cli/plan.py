"""``windopt plan``: the main job, from a measured series to set-points and flights."""

from pathlib import Path
from typing import Annotated

import typer

from windopt.cli import options as opt
from windopt.cli.compiling import tell_of_compiling
from windopt.cli.farm_options import PaceOptions, RotorOptions, SteeringOptions
from windopt.cli.files import require_free, write_folder
from windopt.cli.flight_options import FlightOptions, UavOptions
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.summaries import show_plan
from windopt.cli.terminal import note, overheard, progress
from windopt.cli.times import parsed
from windopt.cli.unfolded import unfolded
from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.domain.wind import WindSeries
from windopt.planning.plan import DEFAULT_FORECASTER
from windopt.planning.plan import plan as make_plan
from windopt.planning.schedule import METHOD as DEFAULT_YAW_METHOD
from windopt.planning.start import LOGGER

WindFile = Annotated[
    Path, typer.Option("--wind", help="CSV file with time, speed and direction, or WIND Toolkit's.")
]


@unfolded
def plan(
    farm: opt.FarmName,
    wind: WindFile,
    time: opt.Time = None,
    forecaster: opt.ForecasterName = DEFAULT_FORECASTER,
    yaw_method: opt.YawMethod = DEFAULT_YAW_METHOD,
    air_density: opt.AirDensity = STANDARD_AIR_DENSITY,
    time_column: opt.Column = "",
    speed_column: opt.Column = "",
    direction_column: opt.Column = "",
    *,
    rotors: RotorOptions,
    steered: SteeringOptions,
    turning: PaceOptions,
    flights: FlightOptions,
    uav: UavOptions,
    json: opt.Json = False,
    out: opt.Out = None,
    force: opt.Force = False,
) -> None:
    """Forecast the wind, set the turbines for each step ahead and plan the flights."""
    require_free(out, force=force)
    at, steering, pace = parsed(time), steered.steering, turning.pace
    series = WindSeries.read(wind, time=time_column, speed=speed_column, direction=direction_column)
    site = rotors.equipped(Farm.load(farm))
    note((*site.notes, *series.notes))
    based, asked = flights.asked(site, uav.uav)
    tell_of_compiling(flights.method)
    told = flights.told(site, based)
    with overheard(LOGGER), progress(f"Planning {site.name}", told) as update:
        made = make_plan(
            site,
            based,
            series,
            time=at,
            forecaster=forecaster,
            yaw_method=yaw_method,
            steering=steering,
            pace=pace,
            air_density=air_density,
            **asked,
            progress=update,
        )
    if json:
        print_record(made)
    else:
        show_plan(made)
    if out is not None:
        write_folder(made, out, force=force, series=series)
    raise typer.Exit(exit_code(made.inspection))
