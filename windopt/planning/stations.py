"""Stations for a farm that has none: the fewest k-means clusters whose UAVs reach everything.

The paper places UAVs by k-means. How many is left open there; here it is the least number from
which every turbine is within reach in the design winds. More clusters may reach less, so the
numbers are tried one after the other.
"""

from collections.abc import Sequence

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Station, Uav
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.heuristics.placement import place_stations
from windopt.planning.reach import dwell_per_turbine, in_reach

DESIGN_SPEED = 10.0
"""Wind speed in which every turbine shall be within reach [m/s], as in the paper's example."""

DESIGN_SHARE = DESIGN_SPEED / FALCON_8.airspeed
"""The most it may be of the airspeed [-], so that slower UAVs fare as the paper's."""


def design_winds(uav: Uav) -> tuple[Wind, ...]:
    """Return winds from all around, of the design speed or as much of it as ``uav`` flies in."""
    speed = min(DESIGN_SPEED, DESIGN_SHARE * uav.airspeed, uav.wind_max)
    return tuple(Wind.from_met(speed, direction) for direction in range(0, 360, 30))


def stations_by_k_means(
    farm: Farm,
    count: int | None = None,
    *,
    uav: Uav = FALCON_8,
    dwell: float | Sequence[float] = 0.0,
    winds: Sequence[Wind] | None = None,
    seed: int = 0,
) -> Fleet:
    """Place stations at the centres of k-means clusters of the turbines.

    Parameters
    ----------
    count
        How many; as few as reach every turbine in all of ``winds`` unless given.
    uav
        The make of UAV kept at each.
    dwell
        Time spent at each turbine [s].
    winds
        Design winds, those of :func:`design_winds` unless given; any that the UAV cannot fly in
        are left out.

    Raises
    ------
    InvalidInput
        If ``count`` is not between 1 and the number of turbines, or a dwell is longer than a
        flight.
    """
    if count is not None:
        if not 1 <= count <= len(farm):
            raise InvalidInput("stations", f"to number 1 to {len(farm)}", count)
        return _fleet(farm, count, uav, seed)
    dwells = dwell_per_turbine(farm, dwell)
    if max(dwells) > uav.t_max:
        raise InvalidInput("dwell", f"<= t_max = {uav.t_max:g} s", f"{max(dwells):g}")
    given = design_winds(uav) if winds is None else winds
    flown = [wind for wind in given if wind.speed <= uav.wind_max and wind.speed < uav.airspeed]

    for k in range(1, len(farm)):
        fleet = _fleet(farm, k, uav, seed)
        if all(in_reach(farm, fleet, wind, dwell=dwells).any(axis=0).all() for wind in flown):
            return fleet
    return _fleet(farm, len(farm), uav, seed)  # one at each turbine, which takes no flying


def _fleet(farm: Farm, count: int, uav: Uav, seed: int) -> Fleet:
    centres = place_stations(farm.xy, count, seed=seed)
    return Fleet(
        tuple(Station(f"S{i}", float(x), float(y), uav) for i, (x, y) in enumerate(centres, 1))
    )
