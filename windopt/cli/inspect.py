"""``windopt inspect``: flights for one steady wind."""

import typer

from windopt.cli import options as opt
from windopt.cli.certificate import require_new, write_proof
from windopt.cli.compiling import tell_of_compiling
from windopt.cli.files import require_free, write_folder
from windopt.cli.flight_options import FlightOptions, UavOptions
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.summaries import show_inspection
from windopt.cli.terminal import note, overheard, progress
from windopt.cli.unfolded import unfolded
from windopt.domain.farm import Farm
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection
from windopt.planning.start import LOGGER


@unfolded
def inspect(
    farm: opt.FarmName,
    wind_speed: opt.WindSpeed,
    wind_direction: opt.WindDirection,
    *,
    flights: FlightOptions,
    uav: UavOptions,
    json: opt.Json = False,
    out: opt.Out = None,
    certificate: opt.Certificate = None,
    force: opt.Force = False,
) -> None:
    """Plan flights that inspect every turbine within reach in the least total time."""
    require_free(out, force=force)
    require_new(certificate, force=force)
    wind = Wind.from_met(wind_speed, wind_direction)
    site = Farm.load(farm)
    note(site.notes)
    based, asked = flights.asked(site, uav.uav)
    tell_of_compiling(flights.method)
    task = f"Planning flights for {site.name} by {flights.method}"
    with overheard(LOGGER), progress(task, flights.told(site, based)) as update:
        result = plan_inspection(site, based, wind, **asked, progress=update)
    if json:
        print_record(result)
    else:
        show_inspection(result)
    if out is not None:
        write_folder(result, out, force=force)
    if certificate is not None:
        time_limit, memory = asked["time_limit"], asked["memory"]
        write_proof(result, certificate, out, time_limit=time_limit, memory=memory, force=force)
    raise typer.Exit(exit_code(result))
