"""``windopt yaw``: set-points for one steady wind."""

from enum import StrEnum
from math import radians
from typing import Annotated, Any

import typer

from windopt.cli import options as opt
from windopt.cli.checked import checked, require_direction
from windopt.cli.farm_options import RotorOptions, SteeringOptions
from windopt.cli.files import require_free, write_folder
from windopt.cli.outcome import exit_code, print_record
from windopt.cli.summaries import show_yaw
from windopt.cli.terminal import note, progress
from windopt.cli.unfolded import unfolded
from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.turbine_yaw import AIR_DENSITY, plan_turbine_yaw
from windopt.planning.yaw import DEFAULT_METHOD, plan_yaw

Nacelle = Annotated[
    float | None,
    typer.Option(
        callback=checked(require_direction),
        help="Where every nacelle faces now [deg]; by default into the wind.",
    ),
]
AirDensity = Annotated[
    float | None,
    typer.Option(
        help=f"Air density [kg/m3]; by default {STANDARD_AIR_DENSITY}, without wakes the paper's "
        f"{AIR_DENSITY}."
    ),
]


class Wakes(StrEnum):
    """Whether turbines feel each other."""

    GAUSS = "gauss"
    NONE = "none"


WITHOUT_WAKES = "to be gauss with --turbulence, --bounds, --direction-std or --farm-cap"

WakeModel = Annotated[
    Wakes,
    typer.Option(
        help="FLORIS's gauss model, or none: the paper's problem, each turbine by itself, with "
        "pitch and tip-speed ratio (methods nlp and algorithm-1)."
    ),
]


@unfolded
def yaw(
    farm: opt.FarmName,
    wind_speed: opt.WindSpeed,
    wind_direction: opt.WindDirection,
    method: opt.YawMethod = DEFAULT_METHOD,
    wakes: WakeModel = Wakes.GAUSS,
    nacelle: Nacelle = None,
    air_density: AirDensity = None,
    time_limit: opt.TimeLimit = 60.0,
    seed: opt.Seed = 0,
    *,
    rotors: RotorOptions,
    steered: SteeringOptions,
    json: opt.Json = False,
    out: opt.Out = None,
    force: opt.Force = False,
) -> None:
    """Turn every rotor so that, under the wakes of the others, the farm delivers the most power."""
    require_free(out, force=force)
    wind = Wind.from_met(wind_speed, wind_direction)
    site = rotors.equipped(Farm.load(farm))
    note(site.notes)
    if wakes is Wakes.NONE and steered != SteeringOptions():
        raise InvalidInput("--wakes", WITHOUT_WAKES, wakes)
    asked: dict[str, Any] = {"method": method, "time_limit": time_limit, "seed": seed}
    if nacelle is not None:
        asked["nacelle"] = radians(nacelle)
    if air_density is not None:  # each problem has its own
        asked["air_density"] = air_density
    with progress(f"Setting {len(site)} turbines of {site.name} by {method}"):
        if wakes is Wakes.GAUSS:
            result = plan_yaw(site, wind, steering=steered.steering, **asked)
        else:
            result = plan_turbine_yaw(site, wind, **asked)
    if json:
        print_record(result)
    else:
        show_yaw(result)
    if out is not None:
        write_folder(result, out, force=force)
    raise typer.Exit(exit_code(result))
