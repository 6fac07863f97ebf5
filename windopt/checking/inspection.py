"""Checks of inspection flights: who is visited, how long it takes, and at what speeds."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, isclose, isfinite

from windopt.checking.coverage import assigned, coverage, flights_sent, worths
from windopt.checking.legs import Displacement, airspeed, least_time, time_by_the_papers_rule
from windopt.checking.report import Report
from windopt.domain.fleet import Station
from windopt.domain.plan import Flight, InspectionPlan, SpeedRule
from windopt.domain.wind import Wind

TOLERANCE = 1e-6
"""Relative; a duration is a sum of some twenty terms, each rounded at 1e-16."""


@dataclass(frozen=True)
class _Site:
    """A plan's places, dwells and stations by name, so that no flight looks through a farm."""

    places: dict[str, tuple[float, float]]
    dwell: dict[str, float]
    stations: dict[str, Station]
    wind: Wind
    rule: SpeedRule

    @classmethod
    def of(cls, plan: InspectionPlan) -> "_Site":
        return cls(
            {turbine.name: (turbine.x, turbine.y) for turbine in plan.farm.turbines},
            dict(zip(plan.farm.names, plan.dwell, strict=False)),
            {station.name: station for station in plan.fleet.stations},
            plan.wind,
            plan.rule,
        )

    def displacements(self, turbines: tuple[str, ...], station: Station) -> list[Displacement]:
        """Return the legs from the station along the turbines and back [m]."""
        home = (station.x, station.y)
        stops = [home, *(self.places[name] for name in turbines), home]
        return [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(stops)]

    def leg_time(self, d: Displacement, station: Station) -> float:
        rule = time_by_the_papers_rule if self.rule is SpeedRule.PAPER else least_time
        return rule(d, self.wind, station.uav)

    def flying_time(self, turbines: tuple[str, ...], station: Station) -> float:
        legs = self.displacements(turbines, station)
        dwells = sum(self.dwell.get(name, 0.0) for name in turbines)
        return sum(self.leg_time(d, station) for d in legs) + dwells

    def within_reach(self, turbine: str, station: Station) -> bool:
        """Whether the UAV inspects it and is back, with a margin no rounding can fill."""
        if self.wind.speed > station.uav.wind_max or self.wind.speed >= station.uav.airspeed:
            return False
        return self.flying_time((turbine,), station) < station.uav.t_max * (1 - TOLERANCE)


def check_inspection(plan: InspectionPlan) -> Report:
    """Recompute every flight of a plan."""
    site = _Site.of(plan)
    violations = [*coverage(plan, site.within_reach), *_dwells(plan)]
    violations += [*worths(plan), *flights_sent(plan), *assigned(plan)]
    warnings: list[str] = []
    for number, flight in enumerate(plan.flights, 1):
        subject = f"flight {number} from {flight.station}"
        violations += [f"{subject}: {sentence}" for sentence in _flight(flight, site)]
        warnings += [f"{subject}: {sentence}" for sentence in _paper_speeds(flight, site)]
    return Report(tuple(violations), tuple(warnings), flights=len(plan.flights))


def _dwells(plan: InspectionPlan) -> Iterator[str]:
    if len(plan.dwell) != len(plan.farm):
        yield f"{len(plan.dwell)} dwells for {len(plan.farm)} turbines"
    if any(not (isfinite(dwell) and dwell >= 0) for dwell in plan.dwell):
        yield "a dwell is negative or not a number"


def _flight(flight: Flight, site: _Site) -> Iterator[str]:
    """One flight: its station, its legs, its duration."""
    station = site.stations.get(flight.station)
    if station is None:
        yield "the station is not one of the fleet's"
        return
    if flight.uav != station.uav.name:
        yield f"UAV {flight.uav} is not kept there, {station.uav.name} is"
    if site.wind.speed > station.uav.wind_max:
        wind, limit = site.wind.speed, station.uav.wind_max
        yield f"the wind of {wind:.2f} m/s is above the UAV's limit of {limit:.2f} m/s"
    if site.wind.speed >= station.uav.airspeed:
        wind, limit = site.wind.speed, station.uav.airspeed
        yield f"in the wind of {wind:.2f} m/s a UAV of {limit:.2f} m/s cannot hold its place"
    if not flight.turbines:
        yield "no turbine is visited"
    if not set(flight.turbines) <= site.places.keys():
        return  # the coverage names the unknown turbine
    if len(flight.legs) != len(flight.turbines) + 1:
        yield f"{len(flight.legs)} legs for {len(flight.turbines)} turbines"
        return
    yield from _leg_violations(flight, station, site)
    yield from _duration_violations(flight, station, site)


def _leg_violations(flight: Flight, station: Station, site: _Site) -> Iterator[str]:
    uav = station.uav
    legs = zip(site.displacements(flight.turbines, station), flight.legs, strict=True)
    for number, (d, time) in enumerate(legs, 1):
        expected = site.leg_time(d, station)
        if not isfinite(expected):
            yield f"leg {number} cannot be flown in this wind"
        elif not isclose(time, expected, rel_tol=TOLERANCE, abs_tol=1e-9):
            yield f"leg {number} is said to take {time:.6g} s, the wind allows {expected:.6g} s"
        if time > 0 and uav.ground_speed_cap and hypot(*d) > time * uav.airspeed * (1 + TOLERANCE):
            yield f"leg {number} is flown at {hypot(*d) / time:.2f} m/s, above {uav.airspeed} m/s"


def _duration_violations(flight: Flight, station: Station, site: _Site) -> Iterator[str]:
    expected = site.flying_time(flight.turbines, station)
    if not isclose(flight.duration, expected, rel_tol=TOLERANCE):
        yield f"it is said to last {flight.duration:.6g} s, its legs and dwells {expected:.6g} s"
    longest = max(flight.duration, expected)
    if not longest <= station.uav.t_max * (1 + 1e-9):
        yield f"it lasts {longest:.6g} s, longer than t_max = {station.uav.t_max:.6g} s"


def _paper_speeds(flight: Flight, site: _Site) -> Iterator[str]:
    """Legs that the paper's rule flies faster than the UAV can."""
    station = site.stations.get(flight.station)
    if site.rule is not SpeedRule.PAPER or station is None:
        return
    if not set(flight.turbines) <= site.places.keys():
        return
    legs = site.displacements(flight.turbines, station)
    for number, (d, time) in enumerate(zip(legs, flight.legs, strict=False), 1):
        needed = airspeed(d, time, site.wind) if time > 0 else 0.0
        if needed > station.uav.airspeed * (1 + TOLERANCE):
            limit = station.uav.airspeed
            yield f"leg {number} needs an airspeed of {needed:.2f} m/s, above {limit:.2f} m/s"
