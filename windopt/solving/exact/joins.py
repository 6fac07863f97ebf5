"""Joins: a forward and a backward label and the leg between them make a flight.

Each flight is made once: at the leg during which half of t_max goes by, or, when its last
(first) turbine is inspected before (after) that moment, by one label alone.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints, Labels, Memory, carried, price_of
from windopt.solving.exact.network import SLACK, Floats, Side

ALONE = -1
"""The partner of a label that makes a flight by itself."""


@compiled
def join(
    forward: Labels,
    backward: Labels,
    side: Side,
    memory: Memory,
    penalty: Floats,
    t_max: float,
    half: float,
    limit: float,
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

    Returns
    -------
    Cost of each forward label's best flight, ``limit`` where there is none below it, and the
    backward label it joins, :data:`ALONE` for none.
    """
    layers, n = backward.start.shape
    least = np.full((layers, n), np.inf)  # over this layer and those before it
    for j in range(n):
        lowest = np.inf
        for layer in range(layers):
            if backward.end[layer, j] > backward.start[layer, j]:
                lowest = min(lowest, backward.C[backward.start[layer, j]])
            least[layer, j] = lowest

    cost = np.full(len(forward.T), limit)
    partner = np.full(len(forward.T), ALONE, np.int32)
    for f in range(len(forward.T)):
        i = forward.node[f]
        if forward.T[f] + side.last[i] <= t_max + SLACK:
            cost[f] = min(limit, forward.C[f] + side.last[i])
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            t = forward.T[f] + side.legs[i, j]
            left = t_max - t + SLACK
            if t <= half or left < 0.0:
                continue
            c = forward.C[f] + side.legs[i, j]
            V = forward.V[f]
            known = False
            for layer in range(layers):
                if backward.opens[layer] > left:
                    break
                if layer + 1 < layers and c + least[layer, j] >= cost[f]:
                    continue
                if not known:
                    if V & memory.bit[i, j] != NONE:
                        break
                    V = carried(V, i, j, memory)
                    known = True
                for b in range(backward.start[layer, j], backward.end[layer, j]):
                    total = c + backward.C[b]
                    if total >= cost[f]:
                        break
                    if backward.T[b] > left or backward.V[b] & V != NONE:
                        continue
                    for word in range(forward.S.shape[1]):
                        both = forward.S[f, word] & backward.S[b, word]
                        total += price_of(both, word, penalty)
                    if total < cost[f]:
                        cost[f] = total
                        partner[f] = b
    return cost, partner


def alone(
    backward: Labels, side: Side, t_max: float, half: float
) -> tuple[NDArray[np.intp], Floats]:
    """Return the backward labels that are flights by themselves, and their costs.

    They are those whose first leg, from the station, takes more than half of t_max: no forward
    label reaches their first turbine in time.
    """
    first = side.first[backward.node]
    whole = np.flatnonzero((first > half) & (first + backward.T <= t_max + SLACK))
    return whole, backward.C[whole] + first[whole]
