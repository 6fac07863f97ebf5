"""What Algorithm 2 is compared with: the same tours and flights, without reassignment.

Each UAV inspects the turbines it looks after, whatever the wind. Only a turbine from which its
UAV could not return in time moves, to the nearest UAV that can; no plan could visit it otherwise.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.splitting import Split, split_optimally
from windopt.heuristics.tours import fly_within
from windopt.result import Result


def baseline(
    instance: RoutingInstance,
    *,
    assigned: NDArray[np.intp] | None = None,
    split: Split = split_optimally,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[tuple[Route, ...]]:
    """Plan flights UAV by UAV, each for the turbines it looks after.

    Parameters
    ----------
    assigned
        The station that looks after each turbine, shape ``(n,)``; the nearest unless given.
    split
        Cuts a tour into flights.
    time_limit
        Wall-clock limit [s].

    Returns
    -------
    Result
        Feasible, and with a bound on the total time of any plan; the reason says how many
        turbines had to move.

    Raises
    ------
    InvalidInput
        If no UAV can inspect a turbine and be back in time.
    """
    Z = instance.reachable
    return fly_within(instance, Z, assigned=assigned, split=split, time_limit=time_limit, seed=seed)
