"""``windopt inspect``: flights for one steady wind."""

import typer

from windopt.cli import options as opt
from windopt.cli.certificate import require_new, write_proof
from windopt.cli.files import require_free, write_folder
from windopt.cli.fleets import fleet
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.terminal import note, progress, show_inspection
from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Uav
from windopt.domain.wind import Wind
from windopt.planning.inspection import DEFAULT_METHOD, plan_inspection


def inspect(
    farm: opt.FarmName,
    wind_speed: opt.WindSpeed,
    wind_direction: opt.WindDirection,
    stations: opt.Stations = "",
    dwell: opt.Dwell = 0.0,
    method: opt.RoutingMethod = DEFAULT_METHOD,
    rule: opt.Rule = "exact",
    airspeed: opt.Airspeed = FALCON_8.airspeed,
    t_max: opt.FlightTime = FALCON_8.t_max,
    wind_max: opt.WindMax = FALCON_8.wind_max,
    ground_speed_cap: opt.GroundSpeedCap = FALCON_8.ground_speed_cap,
    gap: opt.Gap = 0.0,
    time_limit: opt.TimeLimit = 60.0,
    seed: opt.Seed = 0,
    json: opt.Json = False,
    out: opt.Out = None,
    certificate: opt.Certificate = None,
    force: opt.Force = False,
) -> None:
    """Plan flights that inspect every turbine within reach in the least total time."""
    require_free(out, force=force)
    require_new(certificate, force=force)
    wind = Wind.from_met(wind_speed, wind_direction)
    uav = Uav(FALCON_8.name, airspeed, t_max, wind_max, ground_speed_cap)
    site = Farm.load(farm)
    note(site.notes)
    based = fleet(site, stations, uav, dwell=dwell, seed=seed)
    with progress(f"Planning flights for {site.name} by {method}") as update:
        result = plan_inspection(
            site,
            based,
            wind,
            method=method,
            dwell=dwell,
            rule=rule,
            gap=gap,
            time_limit=time_limit,
            seed=seed,
            progress=update,
        )
    if json:
        print_record(result)
    else:
        show_inspection(result)
    if out is not None:
        write_folder(result, out, force=force)
    if certificate is not None:
        write_proof(result, certificate, out, time_limit, force=force)
    raise typer.Exit(exit_code(result))
