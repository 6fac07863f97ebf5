"""Where UAVs are stationed and which turbines each looks after, before the wind is known.

The paper takes both from Chung et al. (2021, *IEEE Trans. Ind. Informat.* 17, 3032-3043), of which
it says no more than k-means clustering and a non-linear integer program. Here the stations are the
centres of k-means clusters, and each turbine belongs to the nearest: the least total distance.
"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import RoutingInstance
from windopt.errors import InvalidInput

STARTS = 10  # Usual number of restarts; k-means ends in a local optimum.
ROUNDS = 300  # Lloyd's method settles in a few dozen; this only bounds it.

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]


def place_stations(turbines: Floats, k: int, *, seed: int = 0) -> Floats:
    """Place k stations at the centres of k-means clusters of the turbines.

    Lloyd's method from k-means++ seeds (Arthur & Vassilvitskii 2007, *Proc. SODA*, 1027-1035), the
    best of ten starts.

    Parameters
    ----------
    turbines
        Positions [m], shape ``(n, 2)``.
    k
        How many stations, 1 to n.

    Returns
    -------
    NDArray
        Positions of the stations [m], shape ``(k, 2)``.

    Raises
    ------
    InvalidInput
        If ``k`` is not between 1 and n.
    """
    if not 1 <= k <= len(turbines):
        raise InvalidInput("k", f"between 1 and {len(turbines)}", k)
    rng = np.random.default_rng(seed)
    best, least = turbines[:k], inf
    for _ in range(STARTS):
        centres = _lloyd(turbines, _seeds(turbines, k, rng))
        spread = float(_squared_distances(turbines, centres).min(axis=1).sum())
        if spread < least:
            best, least = centres, spread
    return best


def distances(instance: RoutingInstance) -> Floats:
    """Return the distance of each station from each turbine [m], shape ``(k, n)``."""
    return np.sqrt(_squared_distances(instance.stations, instance.turbines))


def nearest_stations(instance: RoutingInstance) -> Ints:
    """Assign each turbine to the nearest station, which is its k-means cluster.

    Returns
    -------
    NDArray
        The station of each turbine, shape ``(n,)``.
    """
    nearest: Ints = distances(instance).argmin(axis=0)
    return nearest


def _seeds(points: Floats, k: int, rng: np.random.Generator) -> Floats:
    """Draw k of the points, each with chance in proportion to its squared distance from those."""
    centres = points[rng.integers(len(points), size=1)]
    weight = _squared_distances(points, centres)[:, 0]
    while len(centres) < k:
        if not weight.any():
            weight[:] = 1.0  # Every point is a centre already: turbines stand on one another.
        chosen = rng.choice(len(points), size=1, p=weight / weight.sum())
        centres = np.vstack([centres, points[chosen]])
        weight = np.minimum(weight, _squared_distances(points, points[chosen])[:, 0])
    return centres


def _lloyd(points: Floats, centres: Floats) -> Floats:
    """Move each centre to the mean of the points nearest to it until none moves."""
    for _ in range(ROUNDS):
        cluster = _squared_distances(points, centres).argmin(axis=1)
        size = np.bincount(cluster, minlength=len(centres))
        total = [np.bincount(cluster, axis, len(centres)) for axis in points.T]
        moved = np.where(size > 0, total / np.maximum(size, 1), centres.T).T
        if np.array_equal(moved, centres):
            break
        centres = moved
    return centres


def _squared_distances(a: Floats, b: Floats) -> Floats:
    return np.asarray(((a[:, None] - b[None]) ** 2).sum(axis=-1))
