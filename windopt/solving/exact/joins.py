"""Joins: a forward and a backward label and the leg between them make a flight.

Each flight is made once: at the leg during which half of t_max goes by, or, when its last
(first) turbine is inspected before (after) that moment, by one label alone.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.labels import (
    Ints,
    Labels,
    Memory,
    Prices,
    Words,
    carried,
    price_of,
    recalled,
)
from windopt.solving.exact.network import SLACK, Floats, Side

ALONE = -1
"""The partner of a label that makes a flight by itself."""


@compiled
def cheapest(found: Labels) -> Floats:
    """Return the least cost of a label in each layer and those before, shape ``(layers, n)``."""
    layers, n = found.start.shape
    least = np.full((layers, n), np.inf)
    for j in range(n):
        lowest = np.inf
        for layer in range(layers):
            if found.end[layer, j] > found.start[layer, j]:
                lowest = min(lowest, found.C[found.start[layer, j]])
            least[layer, j] = lowest
    return least


@compiled
def partner(
    found: Labels,
    least: Floats,
    j: int,
    V: np.uint64,
    S: Words,
    row: int,
    left: float,
    below: float,
    enough: float,
    penalty: Floats,
) -> tuple[float, int]:
    """Find the cheapest label at j that goes with turbines V and parities ``S[row]``.

    Parameters
    ----------
    least
        Of :func:`cheapest`.
    left, below, enough
        Longest time of the label, cost to keep below, and cost that needs no improvement.

    Returns
    -------
    Its cost with the penalties of the join, and the label; ``below`` and :data:`ALONE` for none.
    """
    best, label = below, ALONE
    for layer in range(len(least)):
        if found.opens[layer] > left:
            break
        if least[layer, j] >= best:
            continue
        for b in range(found.start[layer, j], found.end[layer, j]):
            cost = found.C[b]
            if cost >= best:
                break
            if found.T[b] > left or found.V[b] & V != NONE:
                continue
            for word in range(S.shape[1]):
                cost += price_of(S[row, word] & found.S[b, word], word, penalty)
            if cost < best:
                best, label = cost, b
                if best <= enough:
                    return best, label
    return best, label


@inlined
def _joined(
    forward: Labels, f: int, backward: Labels, least: Floats, side: Side, memory: Memory,
    prices: Prices, S: Words, t_max: float, half: float, limit: float,
) -> tuple[float, int]:  # fmt: skip
    """Return the cost of the best flight through label f, and the label it joins."""
    cost, label = limit, ALONE
    i = forward.node[f]
    if forward.T[f] + side.last[i] <= t_max + SLACK:
        cost = min(limit, forward.C[f] + side.last_cost[i])
    for e in range(side.degree[i]):
        j = side.heads[i, e]
        t, so_far = forward.T[f] + side.legs[i, j], forward.C[f] + side.legs_cost[i, j]
        left, below = t_max - t + SLACK, cost - so_far
        if t <= half or left < 0.0 or least[-1, j] >= below:
            continue
        if forward.V[f] & memory.bit[i, j] != NONE:
            continue
        V = carried(forward.V[f], i, j, memory)
        recalled(forward.S, f, prices, i, j, S)
        best, b = partner(backward, least, j, V, S, 0, left, below, -np.inf, prices.penalty)
        if b >= 0:
            cost, label = so_far + best, b
    return cost, label


@compiled
def join(
    forward: Labels,
    backward: Labels,
    side: Side,
    memory: Memory,
    prices: Prices,
    t_max: float,
    half: float,
    limit: float,
    stop: NDArray[np.uint8],
) -> tuple[Floats, Ints]:
    """Find the best flight through each forward label.

    Parameters
    ----------
    side
        The forward side.
    half
        The moment at which labels meet.
    limit
        Flights of this cost and above are of no interest.
    stop
        Set to non-zero by another thread to end the search.

    Returns
    -------
    Cost of each forward label's best flight, ``limit`` where there is none below it, and the
    backward label it joins, :data:`ALONE` for none.
    """
    least = cheapest(backward)
    cost = np.full(len(forward.T), limit)
    label = np.full(len(forward.T), ALONE, np.int32)
    S = np.empty((1, forward.S.shape[1]), np.uint64)
    for f in range(len(forward.T)):
        if stop[0] != 0:
            break
        cost[f], label[f] = _joined(
            forward, f, backward, least, side, memory, prices, S, t_max, half, limit
        )
    return cost, label


def alone(
    backward: Labels, side: Side, t_max: float, half: float
) -> tuple[NDArray[np.intp], Floats]:
    """Return the backward labels that are flights by themselves, and their costs.

    They are those whose first leg, from the station, takes more than half of t_max: no forward
    label reaches their first turbine in time.
    """
    first = side.first[backward.node]
    whole = np.flatnonzero((first > half) & (first + backward.T <= t_max + SLACK))
    return whole, backward.C[whole] + side.first_cost[backward.node[whole]]
