"""What placements of stations achieve in the same design: the exact one and k-means beside it."""

from dataclasses import dataclass

import numpy as np

from windopt.domain.fleet import Fleet
from windopt.planning.station_design import StationDesign
from windopt.planning.stations import stations_by_k_means


@dataclass(frozen=True)
class Placement:
    """Stations, and how well they serve.

    Parameters
    ----------
    method
        What placed them.
    turbines
        How many turbines are inspected soonest from each station.
    beyond
        How many turbines no station reaches in every design wind.
    time
        Total of the round trips to the others [s], each from the quickest station, mean over the
        winds.
    longest
        The longest of them [s], 0 where there is none.
    """

    method: str
    fleet: Fleet
    turbines: tuple[int, ...]
    beyond: int
    time: float
    longest: float


def placement(method: str, fleet: Fleet, design: StationDesign) -> Placement:
    """Return how well stations serve."""
    t = design.round_trips(np.array([(station.x, station.y) for station in fleet.stations]))
    quickest = t.min(axis=0)
    reached = np.isfinite(quickest)
    soonest = np.bincount(t.argmin(axis=0)[reached], minlength=len(fleet))
    served = quickest[reached]
    return Placement(
        method,
        fleet,
        tuple(soonest.tolist()),
        int((~reached).sum()),
        float(served.sum()),
        float(served.max(initial=0.0)),
    )


def k_means_beside(design: StationDesign, count: int, *, seed: int = 0) -> tuple[Placement, ...]:
    """Return what k-means makes of a number of stations, and of as many as it takes from there.

    A dwell that leaves no time to fly is beyond every number; then there is the first only.
    """
    farm, uav = design.farm, design.uav
    same = placement("k-means", stations_by_k_means(farm, count, uav=uav, seed=seed), design)
    if not same.beyond or max(design.dwell) > design.longest:
        return (same,)
    enough = stations_by_k_means(
        farm,
        uav=uav,
        dwell=design.dwell,
        winds=design.winds,
        margin=design.margin,
        least=count,
        seed=seed,
    )
    return same, placement("k-means", enough, design)
