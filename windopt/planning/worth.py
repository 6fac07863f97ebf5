"""What an inspection is worth where not every turbine can have one."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import ceil

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.plan import LeftOut
from windopt.domain.routing import Route, RoutingInstance
from windopt.errors import InvalidInput


def worth_per_turbine(
    farm: Farm, fleet: Fleet, worth: float | Sequence[float] | None
) -> tuple[float, ...] | None:
    """Return what inspecting each turbine is worth [s of flight].

    Where flights are limited and nothing is said, as many turbines as possible come first.

    Raises
    ------
    InvalidInput
        If a worth is negative or missing.
    """
    if worth is None:
        return worth_of_priorities(farm, fleet, {}) if fleet.limited else None
    worths = (worth,) * len(farm) if isinstance(worth, int | float) else tuple(worth)
    if len(worths) != len(farm):
        raise InvalidInput("worth", f"for each of {len(farm)} turbines", f"{len(worths)} values")
    for seconds in worths:
        if not 0 <= seconds < np.inf:
            raise InvalidInput("worth", ">= 0 s and finite", seconds)
    return tuple(float(seconds) for seconds in worths)


def worth_of_priorities(
    farm: Farm, fleet: Fleet, priority: Mapping[str, float]
) -> tuple[float, ...]:
    """Return worths by which the greatest sum of priorities comes first, then the least time.

    A turbine of priority 3 counts as much as three of priority 1. One unit of it is worth more
    than all flights together can last.

    Parameters
    ----------
    priority
        Whole numbers of 1 or more by turbine; 1 for those not named.

    Raises
    ------
    InvalidInput
        If a turbine is not one of the farm's, or a priority not such a number.
    """
    for name, number in priority.items():
        if name not in farm.names:
            raise InvalidInput("priority", "of a turbine of the farm", repr(name))
        if not (number >= 1 and number == int(number)):
            raise InvalidInput(f"priority of {name}", "to be a whole number >= 1", number)
    unit = unit_of_priority(fleet, len(farm))
    return tuple(float(unit * priority.get(name, 1)) for name in farm.names)


def unit_of_priority(fleet: Fleet, n: int) -> int:
    """Return what a unit of priority is worth: more than all flights to n turbines last [s]."""
    stations = [(station.uav.t_max, station.max_flights) for station in fleet.stations]
    limits = sum(t_max * (n if most is None else min(n, most)) for t_max, most in stations)
    return ceil(min(limits, n * max(t_max for t_max, _ in stations))) + 1


def weighed(
    instance: RoutingInstance, fleet: Fleet, worth: Sequence[float] | None
) -> RoutingInstance:
    """Return the instance with its prizes and with the flights that stations have."""
    if worth is None:
        return instance
    most = [station.max_flights for station in fleet.stations]
    return replace(
        instance,
        prize=np.array(worth, float),
        max_flights=np.array([np.inf if m is None else m for m in most], float),
    )


def turbines_left_out(
    routes: Iterable[Route], instance: RoutingInstance, names: Sequence[str]
) -> tuple[LeftOut, ...]:
    """Return the turbines that no route visits, with the reason.

    Parameters
    ----------
    names
        Of the instance's turbines.
    """
    routes = tuple(routes)
    if instance.prize is None or instance.max_flights is None:
        return ()
    sent = np.bincount([route.station for route in routes], minlength=len(instance.t))
    visited = {i for route in routes for i in route.turbines}
    at_home = sent < instance.max_flights
    left_out = []
    for i, name in enumerate(names):
        if i not in visited:
            free = bool((at_home & instance.reachable[:, i]).any())
            reason = (
                f"No inspection for less than a worth of {instance.prize[i]:g} s was found."
                if free
                else "No flight is left from a station within reach."
            )
            left_out.append(LeftOut(name, reason))
    return tuple(left_out)
