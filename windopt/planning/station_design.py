"""What stations are placed for: the winds, dwells and margin in which every turbine is in reach.

A turbine is within reach of a site if a UAV flies there, inspects it and is back with a part of its
battery left, in every one of the design winds. The time of the round trip, which the best sites
keep short, is the mean over those winds.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Uav
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.reach import dwell_per_turbine, flies, round_trips

DESIGN_SPEED = 10.0
"""Wind speed in which every turbine shall be within reach [m/s], as in the paper's example."""

DESIGN_SHARE = DESIGN_SPEED / FALCON_8.airspeed
"""The most it may be of the airspeed [-], so that slower UAVs fare as the paper's."""

MARGIN = 0.05
"""Share of a flight kept in reserve [-].

Between two design winds 30 degrees apart the paper's UAV takes up to 1.6 % longer than in either.
"""

Floats = NDArray[np.float64]


def design_winds(uav: Uav) -> tuple[Wind, ...]:
    """Return winds from all around, of the design speed or as much of it as ``uav`` flies in."""
    speed = min(DESIGN_SPEED, DESIGN_SHARE * uav.airspeed, uav.wind_max)
    return tuple(Wind.from_met(speed, direction) for direction in range(0, 360, 30))


@dataclass(frozen=True)
class StationDesign:
    """A farm, a make of UAV, and in what the one shall be within reach of the other.

    Parameters
    ----------
    dwell
        Time spent at each turbine [s], in the farm's order.
    winds
        Design winds; at least one that the UAV flies in.
    margin
        Share of ``t_max`` that is left on landing [-], below 1.
    """

    farm: Farm
    uav: Uav
    dwell: tuple[float, ...]
    winds: tuple[Wind, ...]
    margin: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.margin < 1.0:
            raise InvalidInput("margin", ">= 0 and < 1", self.margin)
        if not self.winds:
            raise InvalidInput("winds", "to hold one that the UAV flies in", "none")

    @cached_property
    def longest(self) -> float:
        """The longest a round trip may take, dwell included [s]."""
        return self.uav.t_max * (1.0 - self.margin)

    @cached_property
    def radius(self) -> float:
        """How far from a station the turbine of the longest dwell may stand in any direction [m].

        Out and back take longest along the wind.
        """
        along = np.array([wind.velocity / (wind.speed or 1.0) for wind in self.winds])
        along[~along.any(axis=1)] = (1.0, 0.0)
        pace = max(
            float(round_trips(e[None], wind, self.uav, 0.0)[0])
            for e, wind in zip(along, self.winds, strict=True)
        )
        return max(0.0, self.longest - max(self.dwell)) / pace

    def round_trips(self, sites: Floats) -> Floats:
        """Return the mean time of a round trip [s], ``inf`` beyond reach, shape ``(m, n)``.

        No wind makes a round trip shorter than still air does, so that pairs too far apart even
        then are left out at once.
        """
        d = self.farm.xy - sites[:, None]
        dwell = np.broadcast_to(self.dwell, d.shape[:2])
        still = 2.0 * np.hypot(d[..., 0], d[..., 1]) / self.uav.airspeed + dwell
        near = still <= self.longest * (1.0 + 1e-9)
        d, dwell = d[near], dwell[near]
        total, longest = np.zeros(len(d)), np.zeros(len(d))
        for wind in self.winds:
            times = round_trips(d, wind, self.uav, dwell)
            total, longest = total + times, np.maximum(longest, times)
        mean = np.full(near.shape, np.inf)
        mean[near] = np.where(longest <= self.longest, total / len(self.winds), np.inf)
        return mean

    def total_time(self, fleet: Fleet) -> float:
        """Return the mean time of round trips to all turbines, each from the quickest station [s].

        It is ``inf`` where a turbine is beyond reach.
        """
        sites = np.array([(station.x, station.y) for station in fleet.stations])
        return float(self.round_trips(sites).min(axis=0).sum())


def station_design(
    farm: Farm,
    *,
    uav: Uav = FALCON_8,
    dwell: float | Sequence[float] = 0.0,
    winds: Sequence[Wind] | None = None,
    margin: float = MARGIN,
) -> StationDesign:
    """Return the design for a farm, without the winds that the UAV does not fly in.

    Parameters
    ----------
    dwell
        Time spent at each turbine [s]: one for all, or one each in the farm's order.
    winds
        Design winds, those of :func:`design_winds` unless given.

    Raises
    ------
    InvalidInput
        If a dwell is negative or missing, the margin is not in [0, 1), or the UAV flies in none of
        the winds.
    """
    given = design_winds(uav) if winds is None else winds
    flown = tuple(wind for wind in given if flies(uav, wind))
    return StationDesign(farm, uav, dwell_per_turbine(farm, dwell), flown, margin)
