"""Checks of a fleet's places: every turbine within reach, whatever the wind."""

from collections.abc import Iterator, Sequence
from math import hypot

from windopt.checking.legs import least_time
from windopt.checking.report import Report
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind

TOLERANCE = 1e-9
"""Relative; a round trip is a sum of three terms, each rounded at 1e-16."""


def check_stations(
    farm: Farm,
    fleet: Fleet,
    winds: Sequence[Wind],
    *,
    dwell: Sequence[float],
    margin: float,
) -> Report:
    """Recompute the round trips from the stations to every turbine.

    Parameters
    ----------
    winds
        In each of them one station, the same in all, shall inspect the turbine and be back.
    dwell
        Time spent at each turbine [s].
    margin
        The share of ``t_max`` that shall be left on landing [-].
    """
    return Report(tuple(_violations(farm, fleet, winds, dwell, margin)))


def _violations(
    farm: Farm, fleet: Fleet, winds: Sequence[Wind], dwell: Sequence[float], margin: float
) -> Iterator[str]:
    for turbine, pause in zip(farm.turbines, dwell, strict=True):
        nearest_first = sorted(
            fleet.stations, key=lambda at: hypot(turbine.x - at.x, turbine.y - at.y)
        )
        if not any(
            all(
                _round_trip(station, turbine, wind) + pause
                <= station.uav.t_max * (1 - margin) * (1 + TOLERANCE)
                for wind in winds
            )
            for station in nearest_first
        ):
            yield f"turbine {turbine.name} is beyond the reach of every station in some wind"


def _round_trip(station: Station, turbine: Turbine, wind: Wind) -> float:
    d = turbine.x - station.x, turbine.y - station.y
    there_and_back = d, (-d[0], -d[1])
    return sum(least_time(way, wind, station.uav) for way in there_and_back)
