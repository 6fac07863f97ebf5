"""An earlier plan as a start: its flights, as far as this farm, fleet and wind let them fly."""

from collections.abc import Iterator, Sequence
from logging import getLogger

import numpy as np

from windopt.domain.fleet import Fleet
from windopt.domain.plan import Flight, InspectionPlan, Plan, YawPlan
from windopt.domain.routing import Route, RoutingInstance
from windopt.errors import InvalidInput, listed
from windopt.heuristics.splitting import split_optimally
from windopt.result import Result

LOGGER = getLogger("windopt.start")
TOLD = "Starting from the earlier plan: %.2f s in this wind, %d of its %d flights as they were."

Start = InspectionPlan | Result[InspectionPlan] | Plan


def inspection_of(start: Start | Result[YawPlan]) -> InspectionPlan:
    """Return the flights of whatever plan is given.

    Raises
    ------
    InvalidInput
        If there are none.
    """
    if isinstance(start, Plan):
        start = start.inspection
    found = start.solution if isinstance(start, Result) else start
    if not isinstance(found, InspectionPlan):
        raise InvalidInput("start", "to hold inspection flights", "none")
    return found


def routes_of(
    start: InspectionPlan,
    instance: RoutingInstance,
    fleet: Fleet,
    farm_names: Sequence[str],
    reached: Sequence[int],
) -> tuple[Route, ...]:
    """Return the flights of a plan as routes that keep the limits of ``instance``.

    A turbine that its station no longer reaches, or that another flight visits already, is
    dropped from the flight; a flight that takes too long is cut; turbines that no flight visits
    are flown to alone, unless they may be left out; and of a station's flights too many those of
    the least prize are given up. What came of it is logged.

    Parameters
    ----------
    reached
        The instance's turbines among ``farm_names``.

    Raises
    ------
    InvalidInput
        If a turbine or a station of the plan is not known here.
    """
    _require_known(start.flights, fleet, farm_names)
    place = {farm_names[i]: at for at, i in enumerate(reached)}
    kept: list[Route] = []
    visited: set[int] = set()
    for flight in start.flights:
        d = fleet.names.index(flight.station)
        stops = [place[name] for name in dict.fromkeys(flight.turbines) if name in place]
        order = [i for i in stops if i not in visited and instance.reachable[d, i]]
        visited.update(order)
        kept += (Route(d, flight) for flight in _cut(order, d, instance))
    more = _alone(instance, visited)
    routes = (*kept, *more) if instance.prize is None else tuple(_worthiest(kept, instance))
    given = {(flight.station, flight.turbines) for flight in start.flights}
    flown = [(fleet.names[d], tuple(farm_names[reached[i]] for i in order)) for d, order in routes]
    unchanged = sum(flight in given for flight in flown)
    LOGGER.info(TOLD, instance.total(routes), unchanged, len(start.flights))
    return routes


def _require_known(flights: Sequence[Flight], fleet: Fleet, farm_names: Sequence[str]) -> None:
    for flight in flights:
        if flight.station not in fleet.names:
            stations = f"the fleet's stations, {listed(fleet.names)}"
            raise InvalidInput("start", f"to fly from {stations}", repr(flight.station))
        for name in flight.turbines:
            if name not in farm_names:
                raise InvalidInput("start", "to visit turbines of the farm", repr(name))


def _cut(order: Sequence[int], d: int, instance: RoutingInstance) -> Iterator[tuple[int, ...]]:
    """Yield the turbines in the same order, on as many flights as it takes."""
    nodes = np.array([0, *(i + 1 for i in order)])
    t = instance.t[d][np.ix_(nodes, nodes)]
    for flight in split_optimally(range(len(order)), t, float(instance.t_max[d])):
        yield tuple(order[at] for at in flight)


def _alone(instance: RoutingInstance, visited: set[int]) -> Iterator[Route]:
    """Yield the fastest flight to each turbine not visited."""
    trips = np.where(instance.reachable, instance.round_trip, np.inf)
    for i in range(trips.shape[1]):
        if i not in visited:
            yield Route(int(trips[:, i].argmin()), (i,))


def _worthiest(routes: Sequence[Route], instance: RoutingInstance) -> Iterator[Route]:
    """Yield each station's routes of the greatest prize after time, as many as it can fly."""
    assert instance.prize is not None
    assert instance.max_flights is not None
    prize = instance.prize

    def gain(route: Route) -> float:
        return float(prize[list(route.turbines)].sum()) - instance.duration(route)

    for d, most in enumerate(instance.max_flights):
        own = sorted((route for route in routes if route.station == d), key=gain, reverse=True)
        yield from own[: int(min(most, len(own)))]
