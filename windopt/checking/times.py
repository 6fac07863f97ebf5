"""The times of all legs that a plan's UAVs could have flown, leg by leg from the wind."""

from collections.abc import Sequence
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.checking.legs import least_time, time_by_the_papers_rule
from windopt.domain.fleet import Station
from windopt.domain.plan import InspectionPlan, SpeedRule

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

ROUNDING = 1e-9
"""Relative; what a flight may last beyond t_max, as where flights are checked."""


class Times(NamedTuple):
    """The times of one station's legs [s], dwells included; ``inf`` where the UAV does not fly.

    Attributes
    ----------
    out, back
        From the station to each turbine, and from each turbine to the station, shape ``(n,)``.
    between
        Between turbines, shape ``(n, n)``.
    longest
        What a flight may last.
    """

    out: Floats
    back: Floats
    between: Floats
    longest: float

    def reversed(self) -> "Times":
        """Return the times of flights read from their end."""
        turned = np.ascontiguousarray(self.between.T)
        return Times(self.back, self.out, turned, self.longest)


def times_of_legs(plan: InspectionPlan, turbines: Sequence[str]) -> list[Times]:
    """Return the times of each station of a plan, between ``turbines`` in their order."""
    places = {turbine.name: (turbine.x, turbine.y) for turbine in plan.farm.turbines}
    dwells = dict(zip(plan.farm.names, plan.dwell, strict=True))
    stops = [places[name] for name in turbines]
    dwell = np.array([dwells[name] for name in turbines])
    by_make = {station.uav: station for station in plan.fleet.stations}
    between = {uav: _matrix(stops, stops, plan, station) for uav, station in by_make.items()}
    made = []
    for station in plan.fleet.stations:
        home = [(station.x, station.y)]
        out = _matrix(home, stops, plan, station)[0] + dwell
        back = _matrix(stops, home, plan, station)[:, 0].copy()
        legs = between[station.uav] + dwell
        np.fill_diagonal(legs, inf)
        forbidden = ~_allowed(plan, turbines, station)
        out[forbidden] = back[forbidden] = legs[forbidden] = legs[:, forbidden] = inf
        made.append(Times(out, back, legs, station.uav.t_max * (1 + ROUNDING)))
    return made


def _allowed(plan: InspectionPlan, turbines: Sequence[str], station: Station) -> Bools:
    """Return whether a station may inspect each of ``turbines``."""
    if plan.assignment is None:
        return np.ones(len(turbines), bool)
    assigned = dict(zip(plan.farm.names, plan.assignment, strict=True))
    return np.array([station.name in assigned[name] for name in turbines], bool)


def _matrix(
    origins: Sequence[tuple[float, float]],
    ends: Sequence[tuple[float, float]],
    plan: InspectionPlan,
    station: Station,
) -> Floats:
    """Return the flight times from all of ``origins`` to all of ``ends`` [s]."""
    wind, uav = plan.wind, station.uav
    if wind.speed > uav.wind_max or wind.speed >= uav.airspeed:
        return np.full((len(origins), len(ends)), inf)
    rule = time_by_the_papers_rule if plan.rule is SpeedRule.PAPER else least_time
    legs = [[rule((b[0] - a[0], b[1] - a[1]), wind, uav) for b in ends] for a in origins]
    return np.array(legs).reshape(len(origins), len(ends))
