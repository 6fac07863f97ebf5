"""Stations for a farm that has none: the fewest k-means clusters whose UAVs reach everything.

The paper places UAVs by k-means. How many is left open there; here it is the least number from
which every turbine is within reach in the design winds.
"""

from collections.abc import Sequence

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.heuristics.placement import place_stations
from windopt.planning.reach import dwell_per_turbine, routing_instance

DESIGN_SPEED = 10.0
"""Wind speed in which every turbine shall be within reach [m/s], as in the paper's example."""

DESIGN_WINDS = tuple(Wind.from_met(DESIGN_SPEED, direction) for direction in range(0, 360, 30))


def stations_by_k_means(
    farm: Farm,
    count: int | None = None,
    *,
    uav: Uav | None = None,
    dwell: float | Sequence[float] = 0.0,
    winds: Sequence[Wind] = DESIGN_WINDS,
    seed: int = 0,
) -> Fleet:
    """Place stations at the centres of k-means clusters of the turbines.

    Parameters
    ----------
    count
        How many; the fewest from which every turbine is within reach in all of ``winds``
        unless given.
    uav
        The make of UAV kept at each; the paper's unless given.
    dwell
        Time spent at each turbine [s].
    winds
        Design winds; those above the UAV's limit are left out.

    Raises
    ------
    InvalidInput
        If ``count`` is not between 1 and the number of turbines, or a dwell leaves no time to fly.
    """
    uav = uav or Uav()
    if count is not None:
        if not 1 <= count <= len(farm):
            raise InvalidInput("stations", f"to number 1 to {len(farm)}", count)
        return _fleet(farm, count, uav, seed)
    dwells = dwell_per_turbine(farm, dwell)
    flown = [wind for wind in winds if wind.speed <= uav.wind_max]
    for k in range(1, len(farm) + 1):
        fleet = _fleet(farm, k, uav, seed)
        if all(_reaches_everything(farm, fleet, wind, dwells) for wind in flown):
            return fleet
    raise InvalidInput("dwell", f"to leave time to fly within t_max = {uav.t_max} s", max(dwells))


def _fleet(farm: Farm, count: int, uav: Uav, seed: int) -> Fleet:
    centres = place_stations(farm.xy, count, seed=seed)
    return Fleet(
        tuple(Station(f"S{i}", float(x), float(y), uav) for i, (x, y) in enumerate(centres, 1))
    )


def _reaches_everything(farm: Farm, fleet: Fleet, wind: Wind, dwells: Sequence[float]) -> bool:
    instance = routing_instance(farm, fleet, wind, dwell=dwells)
    return bool(instance.reachable.any(axis=0).all())
