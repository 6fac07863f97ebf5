"""Which stations may inspect which turbine: any, or as the paper's UAVs each their own."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.routing import RoutingInstance
from windopt.errors import InvalidInput, listed
from windopt.heuristics.placement import nearest_stations

NEAREST = "nearest"
"""Each turbine to the station at the least distance, as in the paper."""

Assignment = str | Mapping[str, str | Sequence[str]]


def stations_of_turbines(
    farm: Farm, fleet: Fleet, assignment: Assignment | None, instance: RoutingInstance
) -> tuple[tuple[str, ...], ...] | None:
    """Return the names of the stations that may inspect each turbine, ``None`` for any.

    Parameters
    ----------
    assignment
        ``"nearest"``, or a station or several by turbine; any station for those not named.
    instance
        Of all the farm's turbines.

    Raises
    ------
    InvalidInput
        If a turbine or a station is not known, or a turbine is left without a station.
    """
    if assignment is None:
        return None
    if isinstance(assignment, str):
        if assignment != NEAREST:
            raise InvalidInput("assignment", f"to be {NEAREST!r} or a mapping", repr(assignment))
        return tuple((fleet.names[d],) for d in nearest_stations(instance))
    for turbine in assignment:
        if turbine not in farm.names:
            raise InvalidInput("assignment", "of a turbine of the farm", repr(turbine))
    given = (assignment.get(name, fleet.names) for name in farm.names)
    named = tuple(
        (stations,) if isinstance(stations, str) else tuple(stations) for stations in given
    )
    for turbine, stations in zip(farm.names, named, strict=True):
        if not stations or not set(stations) <= set(fleet.names):
            expected = f"to be among {listed(fleet.names)}"
            raise InvalidInput(f"station of {turbine}", expected, ", ".join(stations) or "none")
    return named


def assigned_to(
    instance: RoutingInstance, fleet: Fleet, assignment: tuple[tuple[str, ...], ...] | None
) -> RoutingInstance:
    """Return the instance with each turbine allowed to its stations only."""
    if assignment is None:
        return instance
    own = np.array([[name in stations for stations in assignment] for name in fleet.names])
    return replace(instance, allowed=instance.allowed & own)
