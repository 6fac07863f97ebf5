"""Checks of inspection flights: who is visited, how long it takes, and at what speeds."""

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from math import hypot, isclose, isfinite

from windopt.checking.legs import Displacement, airspeed, least_time, time_by_the_papers_rule
from windopt.checking.report import Report
from windopt.domain.fleet import Station
from windopt.domain.plan import Flight, InspectionPlan, SpeedRule

TOLERANCE = 1e-6
"""Relative; a duration is a sum of some twenty terms, each rounded at 1e-16."""


def check_inspection(plan: InspectionPlan) -> Report:
    """Recompute every flight of a plan."""
    violations = [*_coverage(plan), *_dwells(plan)]
    warnings: list[str] = []
    for number, flight in enumerate(plan.flights, 1):
        subject = f"flight {number} from {flight.station}"
        violations += [f"{subject}: {sentence}" for sentence in _flight(flight, plan)]
        warnings += [f"{subject}: {sentence}" for sentence in _paper_speeds(flight, plan)]
    return Report(tuple(violations), tuple(warnings), flights=len(plan.flights))


def _coverage(plan: InspectionPlan) -> Iterator[str]:
    """Every reachable turbine once, the others listed, and nothing else."""
    visits = Counter(name for flight in plan.flights for name in flight.turbines)
    listed = Counter(left_out.turbine for left_out in plan.unreachable)
    known = set(plan.farm.names)
    for name in (visits | listed).keys() - known:
        yield f"turbine {name} is not one of the farm's"
    for name in plan.farm.names:
        if visits[name] > 1:
            yield f"turbine {name} is visited {visits[name]} times"
        if listed[name] > 1:
            yield f"turbine {name} is listed as unreachable {listed[name]} times"
        if not visits[name] and not listed[name]:
            yield f"turbine {name} is neither visited nor listed as unreachable"
        if visits[name] and listed[name]:
            yield f"turbine {name} is visited though listed as unreachable"
    for name in known & listed.keys():
        for station in plan.fleet.stations:
            if _within_reach(name, station, plan):
                yield f"turbine {name} is listed as unreachable, but {station.name} reaches it"


def _dwells(plan: InspectionPlan) -> Iterator[str]:
    if len(plan.dwell) != len(plan.farm):
        yield f"{len(plan.dwell)} dwells for {len(plan.farm)} turbines"
    if any(not (isfinite(dwell) and dwell >= 0) for dwell in plan.dwell):
        yield "a dwell is negative or not a number"


def _within_reach(name: str, station: Station, plan: InspectionPlan) -> bool:
    """Whether the UAV inspects the turbine and is back, with a margin no rounding can fill."""
    if plan.wind.speed > station.uav.wind_max:
        return False
    return _flying_time((name,), station, plan) < station.uav.t_max * (1 - TOLERANCE)


def _flying_time(turbines: tuple[str, ...], station: Station, plan: InspectionPlan) -> float:
    legs = _displacements(turbines, station, plan)
    return sum(_leg_time(d, station, plan) for d in legs) + _dwell(turbines, plan)


def _leg_time(d: Displacement, station: Station, plan: InspectionPlan) -> float:
    rule = time_by_the_papers_rule if plan.rule is SpeedRule.PAPER else least_time
    return rule(d, plan.wind, station.uav)


def _dwell(turbines: tuple[str, ...], plan: InspectionPlan) -> float:
    dwell = dict(zip(plan.farm.names, plan.dwell, strict=False))
    return sum(dwell.get(name, 0.0) for name in turbines)


def _displacements(
    turbines: tuple[str, ...], station: Station, plan: InspectionPlan
) -> list[Displacement]:
    """Return the legs from the station along the turbines and back [m]."""
    places = {turbine.name: (turbine.x, turbine.y) for turbine in plan.farm.turbines}
    home = (station.x, station.y)
    stops = [home, *(places[name] for name in turbines), home]
    return [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(stops)]


def _flight(flight: Flight, plan: InspectionPlan) -> Iterator[str]:
    """One flight: its station, its legs, its duration."""
    station = _station(flight, plan)
    if station is None:
        yield "the station is not one of the fleet's"
        return
    if flight.uav != station.uav.name:
        yield f"UAV {flight.uav} is not kept there, {station.uav.name} is"
    if plan.wind.speed > station.uav.wind_max:
        wind, limit = plan.wind.speed, station.uav.wind_max
        yield f"the wind of {wind:.2f} m/s is above the UAV's limit of {limit:.2f} m/s"
    if not flight.turbines:
        yield "no turbine is visited"
    if not set(flight.turbines) <= set(plan.farm.names):
        return  # the coverage names the unknown turbine
    if len(flight.legs) != len(flight.turbines) + 1:
        yield f"{len(flight.legs)} legs for {len(flight.turbines)} turbines"
        return
    yield from _leg_violations(flight, station, plan)
    yield from _duration_violations(flight, station, plan)


def _station(flight: Flight, plan: InspectionPlan) -> Station | None:
    return next((s for s in plan.fleet.stations if s.name == flight.station), None)


def _leg_violations(flight: Flight, station: Station, plan: InspectionPlan) -> Iterator[str]:
    for number, (d, time) in enumerate(
        zip(_displacements(flight.turbines, station, plan), flight.legs, strict=True), 1
    ):
        expected = _leg_time(d, station, plan)
        if not isfinite(expected):
            yield f"leg {number} cannot be flown in this wind"
        elif not isclose(time, expected, rel_tol=TOLERANCE, abs_tol=1e-9):
            yield f"leg {number} is said to take {time:.6g} s, the wind allows {expected:.6g} s"
        uav = station.uav
        if time > 0 and uav.ground_speed_cap and hypot(*d) > time * uav.airspeed * (1 + TOLERANCE):
            yield f"leg {number} is flown at {hypot(*d) / time:.2f} m/s, above {uav.airspeed} m/s"


def _duration_violations(flight: Flight, station: Station, plan: InspectionPlan) -> Iterator[str]:
    expected = _flying_time(flight.turbines, station, plan)
    if not isclose(flight.duration, expected, rel_tol=TOLERANCE):
        yield f"it is said to last {flight.duration:.6g} s, its legs and dwells {expected:.6g} s"
    longest = max(flight.duration, expected)
    if not longest <= station.uav.t_max * (1 + 1e-9):
        yield f"it lasts {longest:.6g} s, longer than t_max = {station.uav.t_max:.6g} s"


def _paper_speeds(flight: Flight, plan: InspectionPlan) -> Iterator[str]:
    """Legs that the paper's rule flies faster than the UAV can."""
    station = _station(flight, plan)
    if plan.rule is not SpeedRule.PAPER or station is None:
        return
    if not set(flight.turbines) <= set(plan.farm.names):
        return
    legs = _displacements(flight.turbines, station, plan)
    for number, (d, time) in enumerate(zip(legs, flight.legs, strict=False), 1):
        needed = airspeed(d, time, plan.wind) if time > 0 else 0.0
        if needed > station.uav.airspeed * (1 + TOLERANCE):
            limit = station.uav.airspeed
            yield f"leg {number} needs an airspeed of {needed:.2f} m/s, above {limit:.2f} m/s"
