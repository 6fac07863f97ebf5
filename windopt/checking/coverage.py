"""Checks of what is inspected: who is visited, from where, how often, and who is left out."""

from collections import Counter
from collections.abc import Callable, Iterator
from math import isfinite

from windopt.domain.fleet import Station
from windopt.domain.plan import InspectionPlan

Reaches = Callable[[str, Station], bool]


def coverage(plan: InspectionPlan, within_reach: Reaches) -> Iterator[str]:
    """Check that every turbine is on one flight or in one list, where it belongs.

    Parameters
    ----------
    within_reach
        Whether a station's UAV inspects a turbine and is back in time.
    """
    visits = Counter(name for flight in plan.flights for name in flight.turbines)
    listed = Counter(unreachable.turbine for unreachable in plan.unreachable)
    left = Counter(left_out.turbine for left_out in plan.left_out)
    for name in sorted((visits | listed | left).keys() - set(plan.farm.names)):
        yield f"turbine {name} is not one of the farm's"
    for name in plan.farm.names:
        if visits[name] > 1:
            yield f"turbine {name} is visited {visits[name]} times"
        for title, lists in ("unreachable", listed), ("left out", left):
            if lists[name] > 1:
                yield f"turbine {name} is listed as {title} {lists[name]} times"
            if visits[name] and lists[name]:
                yield f"turbine {name} is visited though listed as {title}"
        if listed[name] and left[name]:
            yield f"turbine {name} is listed both as unreachable and as left out"
        if not (visits[name] or listed[name] or left[name]):
            yield f"turbine {name} is neither visited nor listed as unreachable or left out"
        for station in _allowed(plan, name) if listed[name] else ():
            if within_reach(name, station):
                yield f"turbine {name} is listed as unreachable, but {station.name} reaches it"


def worths(plan: InspectionPlan) -> Iterator[str]:
    """Check that turbines have a worth where some are left out."""
    if plan.worth is None:
        if plan.left_out:
            yield "turbines are left out, though none has a worth"
        return
    if len(plan.worth) != len(plan.farm):
        yield f"{len(plan.worth)} worths for {len(plan.farm)} turbines"
    if any(not (isfinite(worth) and worth >= 0) for worth in plan.worth):
        yield "a worth is negative or not a number"


def flights_sent(plan: InspectionPlan) -> Iterator[str]:
    """Check that no station flies more often than it can."""
    sent = Counter(flight.station for flight in plan.flights)
    for station in plan.fleet.stations:
        most = station.max_flights
        if most is not None and sent[station.name] > most:
            yield f"{station.name} flies {sent[station.name]} times, {most} are possible"


def assigned(plan: InspectionPlan) -> Iterator[str]:
    """Check that every turbine is inspected from a station that may do so."""
    if plan.assignment is None:
        return
    if len(plan.assignment) != len(plan.farm):
        yield f"stations are assigned to {len(plan.assignment)} of {len(plan.farm)} turbines"
    for name in sorted({name for names in plan.assignment for name in names}):
        if name not in plan.fleet.names:
            yield f"station {name}, assigned to a turbine, is not one of the fleet's"
    stations = dict(zip(plan.farm.names, plan.assignment, strict=False))
    for flight in plan.flights:
        for name in flight.turbines:
            if flight.station not in stations.get(name, (flight.station,)):
                yield f"turbine {name} is inspected from {flight.station}, not its own station"


def _allowed(plan: InspectionPlan, turbine: str) -> list[Station]:
    """Return the stations that may inspect a turbine."""
    if plan.assignment is None:
        return list(plan.fleet.stations)
    allowed = dict(zip(plan.farm.names, plan.assignment, strict=False)).get(turbine, ())
    return [station for station in plan.fleet.stations if station.name in allowed]
