"""From ranges to flights: who inspects what, in which tour, and where that is split.

Algorithm 2 from line 4 on, and what its baseline shares with it.
"""

from collections.abc import Sequence
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from formulations.tour import tour
from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.placement import nearest_stations
from windopt.heuristics.reassignment import reassign
from windopt.heuristics.relaxation import NAME, least_total_time
from windopt.heuristics.splitting import Split
from windopt.result import Result, Status
from windopt.solving.integer import solve

TIE = 1e-9  # Difference between objective and bound that is rounding, as a fraction.


def fly_within(
    instance: RoutingInstance,
    Z: NDArray[np.bool_],
    *,
    assigned: NDArray[np.intp] | None,
    split: Split,
    time_limit: float,
    seed: int,
) -> Result[tuple[Route, ...]]:
    """Reassign the turbines outside their UAVs' ranges, then fly each UAV's tour.

    Parameters
    ----------
    Z
        Whether UAV i may take turbine k, shape ``(k, n)``.
    assigned
        The UAV of each turbine before that, shape ``(n,)``; the nearest for ``None``.
    split, time_limit, seed
        As in :func:`fly_tours`.
    """
    N = nearest_stations(instance) if assigned is None else assigned
    N_hat = reassign(instance, N, Z)
    moved = int(np.count_nonzero(N_hat != N))
    return fly_tours(instance, N_hat, split=split, time_limit=time_limit, seed=seed, moved=moved)


def fly_tours(
    instance: RoutingInstance,
    assigned: NDArray[np.intp],
    *,
    split: Split,
    time_limit: float,
    seed: int,
    moved: int = 0,
) -> Result[tuple[Route, ...]]:
    """Find the shortest tour of each UAV through its turbines and split it, lines 11-13.

    Parameters
    ----------
    assigned
        The UAV of each turbine, shape ``(n,)``, each able to inspect it and be back in time.
    split
        Cuts the order of a tour into flights.
    time_limit
        Wall-clock limit of all tours together [s]. What is left of it is shared equally among
        the UAVs still to come; one that runs out of it flies to the turbine soonest reached.
    moved
        How many turbines were reassigned, for the reason.
    """
    began = perf_counter()
    instance.require_all("this heuristic")
    bound = least_total_time(instance)
    uavs = np.unique(assigned).tolist()
    routes: list[Route] = []
    statuses: list[Status] = []
    for waiting, uav in zip(range(len(uavs), 0, -1), uavs, strict=True):
        interrupted = Status.INTERRUPTED in statuses
        left = 0.0 if interrupted else max(0.0, began + time_limit - perf_counter())
        turbines = np.flatnonzero(assigned == uav)
        nodes = np.concatenate([[0], turbines + 1])
        t = instance.t[uav][np.ix_(nodes, nodes)]
        status, order = _order(t, time_limit=left / waiting, seed=seed)
        flights = split(order, t, float(instance.t_max[uav]))
        routes += (Route(uav, tuple(turbines[list(flight)].tolist())) for flight in flights)
        statuses.append(status)

    total = instance.total(tuple(routes))
    return Result(
        _overall(statuses, proved=total <= bound * (1 + TIE)),
        tuple(routes),
        total,
        min(bound, total),
        perf_counter() - began,
        bound_source=NAME,
        reason=_reason(moved, statuses),
    )


def _order(t: NDArray[np.float64], *, time_limit: float, seed: int) -> tuple[Status, Sequence[int]]:
    """Return the turbines in the order of the shortest tour, and how sure that is."""
    program = tour(t)
    soonest = _soonest_next(t)
    result = solve(program, time_limit=time_limit, seed=seed, start=_closed_tour(soonest))
    if result.solution is None:
        return result.status, soonest
    [(_, order)] = program.routes(result.solution)
    return result.status, order


def _soonest_next(t: NDArray[np.float64]) -> list[int]:
    """Return the turbines in the order of always flying to the one soonest reached."""
    here, waiting = 0, list(range(1, len(t)))
    order = []
    while waiting:
        here = min(waiting, key=t[here].__getitem__)
        waiting.remove(here)
        order.append(here - 1)
    return order


def _closed_tour(order: Sequence[int]) -> NDArray[np.float64]:
    """Return 1 on the arcs from the station through the turbines and back, 0 elsewhere."""
    nodes = [0, *(turbine + 1 for turbine in order)]
    x = np.zeros((len(nodes), len(nodes)))
    x[nodes, np.roll(nodes, -1)] = 1.0
    return x


def _overall(statuses: list[Status], *, proved: bool) -> Status:
    if proved:
        return Status.OPTIMAL
    return Status.INTERRUPTED if Status.INTERRUPTED in statuses else Status.FEASIBLE


def _reason(moved: int, statuses: list[Status]) -> str:
    sentences = [f"Turbines reassigned: {moved}."] if moved else []
    unproved = sum(status is not Status.OPTIMAL for status in statuses)
    if unproved:
        sentences.append(f"Tours not proved shortest: {unproved} of {len(statuses)}.")
    return " ".join(sentences)
