r"""Algorithm 2: reassign turbines by the flying ranges in this wind, then route UAV by UAV.

| 1.     start from the turbines :math:`N_i` that each UAV looks after
| 2.     move the circle :math:`B_i` of each UAV with the wind
| 3.     intersect both circles: :math:`Z_i`
| 4-10.  give turbines outside :math:`Z_i` to the nearest UAV j that has them in :math:`Z_j`
| 11-12. find the shortest tour of each UAV by branch and cut, without a limit on its time
| 13.    split the tour into flights of :math:`t_i^{\max}` at most

The circles are not the set from which a UAV can return, so here a turbine counts as in range only
if its own round trip is short enough too. Otherwise line 13 could not split the tour.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.flying_range import flying_range as range_under_wind
from windopt.heuristics.splitting import Split, split_optimally
from windopt.heuristics.tours import fly_within
from windopt.result import Result


def algorithm_2(
    instance: RoutingInstance,
    *,
    assigned: NDArray[np.intp] | None = None,
    flying_range: ArrayLike | None = None,
    split: Split = split_optimally,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[tuple[Route, ...]]:
    """Plan flights by the paper's Algorithm 2.

    Parameters
    ----------
    assigned
        The station that looks after each turbine, shape ``(n,)``; the nearest unless given.
    flying_range
        Radius rho of the flying range in still air [m], one for all or one for each station; see
        :mod:`windopt.heuristics.flying_range` for what it is unless given.
    split
        Cuts a tour into flights; :func:`~windopt.heuristics.splitting.split_by_rule` is the
        paper's way.
    time_limit
        Wall-clock limit [s].

    Returns
    -------
    Result
        Feasible, and with a bound on the total time of any plan; the reason says how many
        turbines were reassigned.

    Raises
    ------
    InvalidInput
        If no UAV can inspect a turbine and be back in time, or a radius is negative.
    """
    Z = range_under_wind(instance, flying_range) & instance.reachable
    return fly_within(instance, Z, assigned=assigned, split=split, time_limit=time_limit, seed=seed)
