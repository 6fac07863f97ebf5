"""Options that several commands share, each told once."""

from pathlib import Path
from typing import Annotated

import typer

from windopt.cli.checked import at_least, checked, one_of, require_direction
from windopt.domain.plan import SpeedRule
from windopt.domain.turbine import require_not_negative
from windopt.planning.plan import FORECASTERS, require_forecaster
from windopt.planning.routing_methods import METHODS
from windopt.planning.turbine_yaw import POWER_COEFFICIENTS
from windopt.planning.yaw import METHODS as YAW_METHODS
from windopt.solving.limits import require_gap

FarmName = Annotated[
    str,
    typer.Argument(
        metavar="FARM",
        help="Walney (built in), a farm of OptiWindNet by name (extra farms), or a windIO, FLORIS "
        "or CSV file.",
    ),
]
WindSpeed = Annotated[float, typer.Option(help="Wind speed [m/s].")]
WindDirection = Annotated[
    float,
    typer.Option(
        callback=checked(require_direction),
        help="Where the wind blows from [deg], clockwise from north.",
    ),
]
Stations = Annotated[
    str,
    typer.Option(
        metavar="N|FILE",
        help="Stations: how many to place, or a CSV file (id, x, y). By default the farm's own, "
        "or as few as reach every turbine in 10 m/s from anywhere (slower UAVs: in 5/8 of their "
        "airspeed) with 5 % of the flight to spare; see stations.",
    ),
]
Time = Annotated[
    str | None,
    typer.Option(metavar="ISO", help="On the series' own clock; by default its last row."),
]
Column = Annotated[str, typer.Option(help="Name of the column; recognised by default.")]
Dwell = Annotated[float, typer.Option(help="Time spent at each turbine [s].")]
RoutingMethod = Annotated[
    str,
    typer.Option(callback=checked(one_of(METHODS)), help=f"One of {', '.join(METHODS)}."),
]
YawMethod = Annotated[
    str,
    typer.Option(callback=checked(one_of(YAW_METHODS)), help=f"One of {', '.join(YAW_METHODS)}."),
]
ForecasterName = Annotated[
    str,
    typer.Option(
        callback=checked(require_forecaster),
        help=f"One of {', '.join(FORECASTERS)}, or the file of a trained model.",
    ),
]
Rule = Annotated[
    str,
    typer.Option(
        callback=checked(one_of(SpeedRule)),
        help="How the wind bends the ground speed: exact, or as in the paper.",
    ),
]
Airspeed = Annotated[float, typer.Option(help="Fastest airspeed of the UAVs [m/s].")]
FlightTime = Annotated[float, typer.Option("--t-max", help="Longest flight [s].")]
WindMax = Annotated[float, typer.Option(help="Strongest wind the UAVs fly in [m/s].")]
GroundSpeedCap = Annotated[
    bool, typer.Option(help="Whether the airspeed caps the speed over ground too.")
]
TimeLimit = Annotated[
    float,
    typer.Option(
        callback=checked(require_not_negative), help="Wall-clock limit of the search [s]."
    ),
]
Gap = Annotated[
    float,
    typer.Option(
        callback=checked(require_gap),
        help="Relative gap to stop at, below 1; 0 asks for a proof.",
    ),
]
Seed = Annotated[
    int,
    typer.Option(callback=checked(at_least(0)), help="Seed of whatever is drawn at random."),
]
Json = Annotated[bool, typer.Option("--json", help="Print the record as JSON and nothing else.")]
Out = Annotated[
    Path | None, typer.Option(help="Folder for plan.json, flights.geojson and pictures.")
]
Certificate = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Prove the bound once more, within --time-limit again, and write a certificate that "
        "`windopt check` verifies; beside plan.json too where there is --out.",
    ),
]
Force = Annotated[bool, typer.Option("--force", help="Overwrite files that exist.")]
PowerCoefficient = Annotated[
    str | None,
    typer.Option(
        callback=checked(one_of(POWER_COEFFICIENTS)),
        help=f"C_p model, one of {', '.join(POWER_COEFFICIENTS)}; by default the farm's own.",
    ),
]
AirDensity = Annotated[float, typer.Option(help="Air density [kg/m3].")]
