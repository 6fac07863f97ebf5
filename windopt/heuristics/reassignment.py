"""Algorithm 2, lines 4-10: turbines out of their UAV's range go to one that has them in range."""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import RoutingInstance
from windopt.errors import InvalidInput
from windopt.heuristics.placement import distances


def reassign(
    instance: RoutingInstance, assigned: NDArray[np.intp], Z: NDArray[np.bool_]
) -> NDArray[np.intp]:
    r"""Move each turbine outside its UAV's range to the nearest UAV that has it in range.

    .. math:: j = \arg\min_j \{ d_{jk} : q_k \in Z_j \}

    The UAVs give in the paper's order, that which loses most first, though none takes a turbine
    from another, so any order ends alike. The paper is silent on a turbine that is in no range:
    here it goes to the UAV with the shortest round trip.

    Parameters
    ----------
    assigned
        The UAV of each turbine, shape ``(n,)``.
    Z
        Whether UAV j may take turbine k, shape ``(k, n)``.

    Returns
    -------
    NDArray
        The UAV of each turbine, shape ``(n,)``.

    Raises
    ------
    InvalidInput
        If no UAV can inspect a turbine and be back in time.
    """
    _require_reachable(instance)
    distance = np.where(Z, distances(instance), np.inf)
    round_trip = np.where(instance.reachable, instance.round_trip, np.inf)
    ranked = np.where(Z.any(axis=0), distance, round_trip)

    outside = ~Z[assigned, range(len(assigned))]
    o = [np.flatnonzero(outside & (assigned == i)) for i in range(len(Z))]
    reassigned = assigned.copy()
    for turbines in sorted(o, key=len, reverse=True):
        for k in turbines:
            reassigned[k] = ranked[:, k].argmin()
    return reassigned


def _require_reachable(instance: RoutingInstance) -> None:
    unreachable = np.flatnonzero(~instance.reachable.any(axis=0))
    if len(unreachable):
        raise InvalidInput(
            "every turbine", "within reach of a station", f"turbines {unreachable.tolist()}"
        )
