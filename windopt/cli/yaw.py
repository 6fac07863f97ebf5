"""``windopt yaw``: set-points for one steady wind."""

from math import radians
from typing import Annotated

import typer

from windopt.cli import options as opt
from windopt.cli.files import require_free, write_folder
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.terminal import note, progress, show_yaw
from windopt.domain.farm import Farm
from windopt.domain.wind import Wind
from windopt.planning.yaw import AIR_DENSITY, plan_yaw

Nacelle = Annotated[
    float | None,
    typer.Option(help="Where every nacelle faces now [deg]; by default into the wind."),
]


def yaw(
    farm: opt.FarmName,
    wind_speed: opt.WindSpeed,
    wind_direction: opt.WindDirection,
    method: opt.YawMethod = "nlp",
    nacelle: Nacelle = None,
    air_density: opt.AirDensity = AIR_DENSITY,
    power_coefficient: opt.PowerCoefficient = None,
    time_limit: opt.TimeLimit = 60.0,
    seed: opt.Seed = 0,
    json: opt.Json = False,
    out: opt.Out = None,
    force: opt.Force = False,
) -> None:
    """Set every turbine's yaw, pitch and tip-speed ratio for the most power up to rated."""
    require_free(out, force=force)
    wind = Wind.from_met(wind_speed, wind_direction)
    site = Farm.load(farm)
    if power_coefficient is not None:
        site = site.with_power_coefficient(power_coefficient)
    note(site.notes)
    with progress(f"Setting {len(site)} turbines of {site.name} by {method}"):
        result = plan_yaw(
            site,
            wind,
            method=method,
            nacelle=None if nacelle is None else radians(nacelle),
            air_density=air_density,
            time_limit=time_limit,
            seed=seed,
        )
    if json:
        print_record(result)
    else:
        show_yaw(result)
    if out is not None:
        write_folder(result, out, force=force)
    raise typer.Exit(exit_code(result))
