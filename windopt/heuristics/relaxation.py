r"""A lower bound on the total time of any plan, in milliseconds and for any size.

In a plan every turbine is reached from one place and left for one place, the flights start and
end at stations, and since a flight takes at most :math:`t^{\max}`, a total of :math:`z` takes
:math:`z / t^{\max}` flights or more. Dropping all else (that flights visit a station at all, that
they return to their own, that each is short enough) and charging each leg the least time that
any UAV takes leaves an assignment problem, in which n copies of the station may stay unused.

The bound is valid for any times and far from tight where flights are many: legs that lead round in
circles among neighbours are cheaper than flights from a station.
"""

from math import ceil, inf

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from windopt.domain.routing import RoutingInstance

NAME = "assignment relaxation"


def least_total_time(instance: RoutingInstance) -> float:
    """Return a lower bound on the time of all flights together [s].

    Parameters
    ----------
    instance
        Every turbine within reach of a station.
    """
    t = instance.t.min(axis=0)
    longest = float(instance.t_max.max())
    bound, flights = 0.0, 0
    while (needed := ceil(bound / longest - 1e-9)) > flights or not flights:
        flights = max(needed, 1)
        bound = _assignment(t, flights)
    return bound


def _assignment(t: NDArray[np.float64], flights: int) -> float:
    """Return the least time to reach and leave each turbine, with so many flights or more."""
    n = len(t) - 1
    cost = np.zeros((2 * n, 2 * n))  # The turbines, then n copies of the station.
    cost[:n, :n] = t[1:, 1:]
    cost[range(n), range(n)] = inf
    cost[:n, n:] = t[1:, :1]
    cost[n:, :n] = t[0, 1:]
    cost[n : n + flights, n:] = inf
    left, reached = linear_sum_assignment(cost)
    return float(cost[left, reached].sum())
