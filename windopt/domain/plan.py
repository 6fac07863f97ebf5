"""Plans: what the turbines and the UAVs are told to do."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.steering import Pace, Steering
from windopt.domain.wind import Wind, WindForecast
from windopt.result import Result


class SpeedRule(StrEnum):
    """How the wind bends the speed over ground.

    EXACT is the fastest the wind triangle allows; PAPER is the paper's own rule, which flies at
    full speed over ground in any tail wind.
    """

    EXACT = "exact"
    PAPER = "paper"


@dataclass(frozen=True)
class SetPoint:
    """What one turbine is told.

    Parameters
    ----------
    turbine
        Its name.
    nacelle
        Direction the nacelle faces, clockwise from north [rad].
    misalignment
        Wind direction minus nacelle direction [rad], FLORIS's sign, in [-pi, pi).
    pitch, tip_speed_ratio
        Blade pitch beta [rad] and lambda [-]; ``None`` under wakes, where they are left to the
        turbine's own controller, which follows its power curve.
    wind_speed
        Wind speed at the rotor [m/s]; where several winds may come, the mean.
    power
        Power delivered [W], likewise.
    maximum
        The most any set-point delivers in this wind [W], certified.
    """

    turbine: str
    nacelle: float
    misalignment: float
    pitch: float | None
    tip_speed_ratio: float | None
    wind_speed: float
    power: float
    maximum: float


@dataclass(frozen=True)
class YawPlan:
    """Set-points of all turbines in one steady wind.

    Parameters
    ----------
    power_baseline
        Power of the farm with every nacelle facing the wind [W].
    air_density
        Rho [kg/m3].
    steering
        What the farm is steered under; ``None`` where its turbines are taken one by one, without
        wakes.
    """

    farm: Farm
    wind: Wind
    set_points: tuple[SetPoint, ...]
    power_baseline: float
    air_density: float
    steering: Steering | None = None

    @property
    def power(self) -> float:
        """Power of the farm [W]."""
        return sum(point.power for point in self.set_points)

    @property
    def gain(self) -> float:
        """Power gained over the baseline, as a fraction of it [-]; 0 where there is none."""
        return self.power / self.power_baseline - 1 if self.power_baseline else 0.0


@dataclass(frozen=True)
class Flight:
    """One flight: from its station along the turbines, in order, and back.

    Parameters
    ----------
    station
        Name of the station it starts from and returns to.
    uav
        Make of the UAV.
    turbines
        Names of the turbines, in order.
    legs
        Time of each leg [s], the first from the station and the last back to it.
    duration
        From take-off to landing, inspections included [s].
    """

    station: str
    uav: str
    turbines: tuple[str, ...]
    legs: tuple[float, ...]
    duration: float


@dataclass(frozen=True)
class Unreachable:
    """A turbine that no UAV can inspect, and why."""

    turbine: str
    reason: str


@dataclass(frozen=True)
class LeftOut:
    """A turbine within reach that a plan does not inspect, and why."""

    turbine: str
    reason: str


@dataclass(frozen=True)
class InspectionPlan:
    """Flights that visit every turbine within reach once, in one steady wind.

    Where turbines have a worth, those that cost more, or find no flight, may be left out.

    Parameters
    ----------
    dwell
        Time spent at each turbine [s], in the farm's order.
    rule
        How the wind bends the speed over ground.
    unreachable
        The turbines that no UAV can inspect.
    worth
        What inspecting each turbine is worth [s of flight], in the farm's order; ``None`` where
        all within reach must be inspected.
    left_out
        The turbines within reach that are not inspected.
    assignment
        Names of the stations that may inspect each turbine, in the farm's order; ``None`` where
        any may.
    """

    farm: Farm
    fleet: Fleet
    wind: Wind
    dwell: tuple[float, ...]
    flights: tuple[Flight, ...]
    unreachable: tuple[Unreachable, ...] = ()
    rule: SpeedRule = SpeedRule.EXACT
    worth: tuple[float, ...] | None = None
    left_out: tuple[LeftOut, ...] = ()
    assignment: tuple[tuple[str, ...], ...] | None = None

    @property
    def duration(self) -> float:
        """Time of all flights together [s]."""
        return sum(flight.duration for flight in self.flights)

    @property
    def forgone(self) -> float:
        """What inspecting the turbines left out is worth [s of flight]."""
        if self.worth is None:
            return 0.0
        worth = dict(zip(self.farm.names, self.worth, strict=False))
        return sum(worth.get(left.turbine, 0.0) for left in self.left_out)

    @property
    def cost(self) -> float:
        """What a plan is chosen by: time of all flights, and what is forgone [s]."""
        return self.duration + self.forgone


@dataclass(frozen=True)
class Plan:
    """The whole answer: a forecast, set-points for each of its steps, and flights.

    Parameters
    ----------
    time
        When the plan was made, on the series' own clock.
    yaw
        Set-points for each step of the forecast.
    inspection
        Flights for the forecast's mean wind.
    pace
        How nacelles turn from step to step; ``None`` where nothing is said of it.
    """

    time: np.datetime64
    forecast: WindForecast
    yaw: tuple[Result[YawPlan], ...]
    inspection: Result[InspectionPlan]
    pace: Pace | None = None
