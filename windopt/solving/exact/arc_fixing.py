"""Arc fixing: legs that no flight of interest uses.

Half labels tell which labels may still matter beyond half of t_max. With those the labels of both
sides meet on every leg; a leg is of no use when the best flight over it costs more than the
gap [1].

* [1] Irnich, Desaulniers, Desrosiers & Hadjar (2010), *INFORMS Journal on Computing* 22, 297-313.
"""

from functools import partial

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.both_sides import BothSides
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.completions import (
    Completions,
    completion_bounds,
    tables,
    tightest,
    told_by,
)
from windopt.solving.exact.joins import cheapest, partner
from windopt.solving.exact.labels import EPS, Labels, Memory, Prices, carried, recalled
from windopt.solving.exact.network import SLACK, Floats, Network, Side


@compiled
def _through(
    ahead: Labels,
    behind: Labels,
    side: Side,
    memory: Memory,
    prices: Prices,
    t_max: float,
    rest: Floats,
    step: float,
    limit: float,
    stop: NDArray[np.uint8],
) -> Floats:
    """Return the least cost of a flight over each leg, ``inf`` beyond ``limit``."""
    n = len(side.first)
    cost = np.full((n, n), np.inf)
    least, S = cheapest(behind), np.empty((1, ahead.S.shape[1]), np.uint64)
    for a in range(len(ahead.T)):
        if stop[0] != 0:
            break
        i = ahead.node[a]
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            so_far = ahead.C[a] + side.legs_cost[i, j]
            left = t_max - ahead.T[a] - side.legs[i, j] + SLACK
            below = min(cost[i, j], limit) - so_far + EPS
            if left < 0.0 or rest[j, int(left / step)] - prices.pi[j] >= below:
                continue
            if ahead.V[a] & memory.bit[i, j] != NONE:
                continue
            V = carried(ahead.V[a], i, j, memory)
            recalled(ahead.S, a, prices, i, j, S)
            best, b = partner(behind, least, j, V, S, 0, left, below, -np.inf, prices.penalty)
            if b >= 0:
                cost[i, j] = so_far + best
    return cost


def useful_arcs(
    given: BothSides, loose: BothSides, limits: Floats
) -> tuple[list[Completions], list[Floats]] | None:
    """Find the legs on which a flight may fly that costs no more than ``limits`` of its station.

    Parameters
    ----------
    given, loose
        With all cuts; and without any, for a first bound.
    limits
        Cost that no flight of interest exceeds, shape ``(k,)``.

    Returns
    -------
    For each station what completes its labels, and the least cost of a flight over each leg,
    shape ``(n, n)``; None where labels are too many.
    """
    first = completion_bounds(loose, limits)
    halves, complete = given.labels(first or given.unbounded)
    if not complete:
        return None
    second = told_by(halves, given, limits, whole=False)
    del halves  # labels take memory
    if first is not None:
        second = [tightest(*pair) for pair in zip(first, second, strict=True)]
    wholes, complete = given.labels(second, whole=True)
    if not complete:
        return None
    sides = wholes[::2], wholes[1::2]
    costs = given.clock.map(tables, given.networks, *sides)
    rest = [Completions(*each, *both) for each, *both in zip(costs, *sides, strict=True)]
    return rest, given.clock.map(partial(_least_through, given), given.networks, rest, limits)


def _least_through(given: BothSides, network: Network, rest: Completions, limit: float) -> Floats:
    """Return the least cost of a flight of one station over each leg, shape ``(n, n)``."""
    return _through(
        rest.ahead, rest.behind, network.forward, given.memory, given.prices, network.t_max,
        rest.forward, rest.step, limit, given.clock.stop,
    )  # fmt: skip
