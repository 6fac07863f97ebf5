"""Candidate sites for stations: at turbines, on substations, or anywhere within the farm."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput, require_one_of
from windopt.heuristics.placement import place_stations
from windopt.planning.station_design import StationDesign

DEFAULT_CANDIDATES = "grid"
FINENESS = (
    9  # Grid points within the reach of a station; 12 saved none of ten large farms a station.
)
MOST_POINTS = 64  # Along each side of the grid, so that large farms take seconds.
MOST_CENTRES = 24  # Up to so many clusters; k-means needs no more on any farm of OptiWindNet.

Floats = NDArray[np.float64]


def turbine_sites(design: StationDesign, seed: int) -> Floats:
    """Return the positions of the turbines: stations at their feet."""
    return design.farm.xy


def substation_sites(design: StationDesign, seed: int) -> Floats:
    """Return the positions of the substations, if any are known."""
    return np.array(design.farm.substations, dtype=float).reshape(-1, 2)


def platform_sites(design: StationDesign, seed: int) -> Floats:
    """Return the positions of turbines and substations: wherever something stands already."""
    return np.vstack([turbine_sites(design, seed), substation_sites(design, seed)])


def grid_sites(design: StationDesign, seed: int) -> Floats:
    """Return a grid within the farm's hull, substations and the centres of k-means clusters.

    Whatever k-means achieves with a few clusters is thus within reach of an exact choice. A turbine
    that no such site reaches becomes a site itself.
    """
    xy = design.farm.xy
    most = min(MOST_CENTRES, len(xy))
    centres = [place_stations(xy, k, seed=seed) for k in range(1, most + 1)]
    sites = np.vstack([substation_sites(design, seed), *centres, _grid(design)])
    reached = np.isfinite(design.round_trips(sites)).any(axis=0)
    return np.unique(np.vstack([sites, xy[~reached]]), axis=0)


CANDIDATES: dict[str, Callable[[StationDesign, int], Floats]] = {
    "grid": grid_sites,
    "platforms": platform_sites,
    "turbines": turbine_sites,
    "substations": substation_sites,
}
"""Candidate sites by name, from where a station may be anywhere to where few may."""


def candidate_sites(design: StationDesign, candidates: str | Floats, *, seed: int = 0) -> Floats:
    """Return candidate sites for stations [m], shape ``(m, 2)``.

    Parameters
    ----------
    candidates
        One of :data:`CANDIDATES`, or the sites themselves.

    Raises
    ------
    InvalidInput
        If the name is unknown, there are no sites or they are not finite.
    """
    if isinstance(candidates, str):
        require_one_of("candidates", candidates, CANDIDATES)
        sites = CANDIDATES[candidates](design, seed)
        if not len(sites):
            others = ", ".join(name for name in CANDIDATES if name != candidates)
            raise InvalidInput(
                "candidates", f"one of {others}", f"{candidates}, of which the farm has none"
            )
    else:
        sites = np.asarray(candidates, dtype=float)
    if sites.ndim != 2 or sites.shape[1] != 2 or not len(sites):
        raise InvalidInput("candidates", "to be sites, shape (m, 2)", f"shape {sites.shape}")
    if not np.isfinite(sites).all():
        raise InvalidInput("candidates", "to be finite", "a missing or infinite coordinate")
    return sites


def _grid(design: StationDesign) -> Floats:
    """Return points of a square grid within the hull of the turbines.

    In the plane no site outside the hull is needed, whatever the norm (Wendell & Hurter 1973,
    *Operations Research* 21, 314-320); round trips in all design winds are one.
    """
    xy = design.farm.xy
    corner, extent = xy.min(axis=0), np.ptp(xy, axis=0)
    pitch = max(design.radius / FINENESS, extent.max() / MOST_POINTS)
    if not pitch > 0.0:
        return np.empty((0, 2))
    steps = np.ceil(extent / pitch).astype(int) + 1
    points = corner + pitch * np.array(list(np.ndindex(*steps)))
    return np.asarray(points[_within_hull(points, xy)])


def _within_hull(points: Floats, xy: Floats) -> NDArray[np.bool_]:
    """Whether each point lies in the hull: no half of its horizon is empty of ``xy``."""
    d = xy - points[:, None]
    angles = np.sort(np.arctan2(d[..., 1], d[..., 0]), axis=1)
    gaps = np.diff(angles, axis=1, append=angles[:, :1] + 2 * np.pi)
    return np.asarray(gaps.max(axis=1) <= np.pi + 1e-9)
