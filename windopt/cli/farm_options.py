"""What farm is steered and under what, from options in the units people use."""

from dataclasses import dataclass, replace
from math import degrees, inf, radians
from typing import Annotated

import typer

from windopt.cli import options as opt
from windopt.domain.farm import Farm
from windopt.domain.steering import Pace, Steering
from windopt.domain.turbine import require_not_negative, require_positive
from windopt.io.turbine_types import TYPE_NOTES
from windopt.io.turbines import BUILT_IN, load_turbine_type

TurbineName = Annotated[
    str | None,
    typer.Option(
        metavar="NAME|FILE",
        help=f"Turbine for the whole farm: one of {', '.join(BUILT_IN)}, or a FLORIS or windIO "
        "YAML file; by default the farm's own.",
    ),
]
Turbulence = Annotated[float, typer.Option(help="Ambient turbulence intensity.")]
Bounds = Annotated[
    tuple[float, float],
    typer.Option(metavar="LEAST LARGEST", help="Least and largest misalignment [deg]."),
]
DirectionStd = Annotated[
    float, typer.Option(help="Standard deviation of the wind's direction [deg].")
]
FarmCap = Annotated[float | None, typer.Option(help="The most the grid takes [MW].")]
YawRate = Annotated[float, typer.Option(help="How fast nacelles turn at most [deg/s].")]
YawThreshold = Annotated[
    float, typer.Option(help="Gain in the farm's power below which nacelles stay [%].")
]
USUAL_RATE = degrees(Pace.rate)


@dataclass(frozen=True)
class RotorOptions:
    """The turbines of the farm, where they are not its own."""

    turbine: TurbineName = None
    power_coefficient: opt.PowerCoefficient = None

    def equipped(self, farm: Farm) -> Farm:
        """Return the farm with these turbines."""
        if self.turbine is not None:
            farm = farm.with_turbine_type(load_turbine_type(self.turbine))
            kept = tuple(note for note in farm.notes if note not in TYPE_NOTES)
            farm = replace(farm, notes=kept)
        if self.power_coefficient is not None:
            farm = farm.with_power_coefficient(self.power_coefficient)
        return farm


@dataclass(frozen=True)
class SteeringOptions:
    """Under what a farm is steered."""

    turbulence: Turbulence = Steering.turbulence
    bounds: Bounds = (-25.0, 25.0)
    direction_std: DirectionStd = 0.0
    farm_cap: FarmCap = None

    @property
    def steering(self) -> Steering:
        """The same in SI; a mistake is told in the units it was made in."""
        require_not_negative("--direction-std", self.direction_std)
        require_not_negative("--farm-cap", self.farm_cap or 0.0)
        lower, upper = map(radians, self.bounds)
        cap = inf if self.farm_cap is None else 1e6 * self.farm_cap
        spread = radians(self.direction_std)
        return Steering(self.turbulence, lower, upper, spread, farm_cap=cap)


@dataclass(frozen=True)
class PaceOptions:
    """How nacelles turn from step to step."""

    yaw_rate: YawRate = USUAL_RATE
    yaw_threshold: YawThreshold = 100 * Pace.threshold

    @property
    def pace(self) -> Pace:
        """The same in SI; a mistake is told in the units it was made in."""
        require_positive("--yaw-rate", self.yaw_rate)
        require_not_negative("--yaw-threshold", self.yaw_threshold)
        return Pace(radians(self.yaw_rate), self.yaw_threshold / 100)
