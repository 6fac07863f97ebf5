"""A farm, a fleet and a wind in numbers, and which turbines are within reach."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from formulations.wind_triangle import flight_time, ground_speed, ground_speed_paper
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import SpeedRule, Unreachable
from windopt.domain.routing import RoutingInstance
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput


def routing_instance(
    farm: Farm,
    fleet: Fleet,
    wind: Wind,
    *,
    dwell: Sequence[float],
    rule: SpeedRule = SpeedRule.EXACT,
) -> RoutingInstance:
    """Return the inspection of all of a farm's turbines as arrays.

    Parameters
    ----------
    dwell
        Time spent at each turbine [s], in the farm's order.
    rule
        How the wind bends the speed over ground.
    """
    times = [_times(station, farm, wind, rule) for station in fleet.stations]
    t = np.stack(times)
    t[:, :, 1:] += np.asarray(dwell)
    t[:, range(len(farm) + 1), range(len(farm) + 1)] = 0.0
    return RoutingInstance(
        t=t,
        t_max=np.array([station.uav.t_max for station in fleet.stations]),
        stations=np.array([(station.x, station.y) for station in fleet.stations]),
        turbines=farm.xy,
        w=wind.velocity,
        allowed=np.array([[flies(station.uav, wind)] * len(farm) for station in fleet.stations]),
        airspeed=np.array([station.uav.airspeed for station in fleet.stations]),
    )


def round_trips(
    d: NDArray[np.float64], wind: Wind, uav: Uav, dwell: NDArray[np.float64] | float
) -> NDArray[np.float64]:
    """Return the time of flights to a single turbine and back, with the dwell there [s].

    Parameters
    ----------
    d
        Displacements from station to turbine [m], shape ``(..., 2)``.
    dwell
        Time spent at each turbine [s], shape ``(...)`` or one for all.
    """
    out, back = (
        flight_time(way, ground_speed(way, wind.velocity, uav.airspeed, cap=uav.ground_speed_cap))
        for way in (d, -d)
    )
    times: NDArray[np.float64] = out + dwell + back
    return times


def _times(station: Station, farm: Farm, wind: Wind, rule: SpeedRule) -> NDArray[np.float64]:
    """Return the flight times between a station and the turbines [s], ``(n + 1, n + 1)``."""
    places = np.vstack([(station.x, station.y), farm.xy])
    d = places[None, :] - places[:, None]
    uav = station.uav
    if rule is SpeedRule.PAPER:
        return flight_time(d, ground_speed_paper(d, wind.velocity, uav.airspeed))
    cap = uav.ground_speed_cap
    return flight_time(d, ground_speed(d, wind.velocity, uav.airspeed, cap=cap))


def flies(uav: Uav, wind: Wind) -> bool:
    """Whether a UAV is allowed in the wind, and can stay where it is."""
    return wind.speed <= uav.wind_max and wind.speed < uav.airspeed


def unreachable_turbines(
    farm: Farm, fleet: Fleet, wind: Wind, instance: RoutingInstance
) -> tuple[Unreachable, ...]:
    """Return the turbines that no UAV can inspect and be back in time, with the reason."""
    out_of_reach = np.flatnonzero(~instance.reachable.any(axis=0)).tolist()
    return tuple(
        Unreachable(farm.names[i], _reason(fleet, wind, instance, i)) for i in out_of_reach
    )


def _stations_of(fleet: Fleet, wind: Wind, instance: RoutingInstance, i: int) -> Sequence[Station]:
    """Return the stations that may inspect turbine i, in the wind or if it were weaker."""
    flown = np.array([flies(station.uav, wind) for station in fleet.stations])
    own = instance.allowed[:, i] | ~flown
    return [station for station, one in zip(fleet.stations, own, strict=True) if one]


def _reason(fleet: Fleet, wind: Wind, instance: RoutingInstance, i: int) -> str:
    stations = _stations_of(fleet, wind, instance, i)
    if not any(flies(station.uav, wind) for station in stations):
        limit = max(station.uav.wind_max for station in stations)
        if wind.speed > limit:
            return f"The wind of {wind.speed:.1f} m/s is above the UAVs' limit of {limit:.1f} m/s."
        fastest = max(station.uav.airspeed for station in stations)
        return f"The wind of {wind.speed:.1f} m/s is not below the airspeed of {fastest:.1f} m/s."
    round_trip = np.where(instance.allowed[:, i], instance.round_trip[:, i], np.inf)
    excess = round_trip - instance.t_max
    nearest = int(np.argmin(excess))
    station = fleet.stations[nearest]
    if np.isinf(round_trip[nearest]):
        return f"No UAV of {station.uav.airspeed:.1f} m/s airspeed holds the course in this wind."
    return (
        f"The round trip from {station.name}, the nearest in time, takes "
        f"{round_trip[nearest]:.1f} s of {instance.t_max[nearest]:.1f} s."
    )


def dwell_per_turbine(farm: Farm, dwell: float | Sequence[float]) -> tuple[float, ...]:
    """Return the dwell at each turbine [s].

    Raises
    ------
    InvalidInput
        If a dwell is negative or missing.
    """
    dwells = (dwell,) * len(farm) if isinstance(dwell, int | float) else tuple(dwell)
    if len(dwells) != len(farm):
        raise InvalidInput("dwell", f"for each of {len(farm)} turbines", f"{len(dwells)} values")
    for seconds in dwells:
        if not 0 <= seconds < np.inf:
            raise InvalidInput("dwell", ">= 0 s and finite", seconds)
    return tuple(float(seconds) for seconds in dwells)
