"""Flight times in hundredths of a second, for solvers that count in whole numbers.

Rounded up, so that a flight that is short enough in whole numbers is short enough.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import RoutingInstance

UNITS = 100
"""To the second."""

TOO_LONG = 10_000_000
"""A leg that fits into no flight [units]."""

ROUNDING = 1e-6
"""Units by which a time may exceed a whole number and be taken for it."""


def whole_times(instance: RoutingInstance, d: int) -> NDArray[np.int64]:
    """Return the times of the UAVs of station d among all stations and turbines [units].

    The first nodes are the stations, shape ``(k + n, k + n)``. Legs from and to the other stations
    are those of the UAVs there: no flight of station d has them.
    """
    k, n = len(instance.stations), len(instance.turbines)
    seconds = np.full((k + n, k + n), np.inf)
    seconds[:k, k:] = instance.t[:, 0, 1:]
    seconds[k:, :k] = instance.t[:, 1:, 0].T
    seconds[k:, k:] = instance.t[d, 1:, 1:]
    seconds[:, k:][:, ~instance.allowed[d]] = np.inf
    np.fill_diagonal(seconds, 0.0)
    units = np.minimum(np.ceil(UNITS * seconds - ROUNDING), TOO_LONG)
    return units.astype(np.int64)


def whole_limits(instance: RoutingInstance) -> list[int]:
    """Return the longest flight of each station's UAV, rounded down [units]."""
    limits: list[int] = np.floor(UNITS * instance.t_max + ROUNDING).astype(int).tolist()
    return limits
