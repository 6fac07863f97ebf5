"""Labelling: the partial flights of one station that no other one makes useless.

Labels of equal time are told apart by layers: a layer holds the labels of one time bucket and is
final when the next begins, because only legs shorter than a bucket stay in it, and those open a
layer of their own.

* [1] Baldacci, Mingozzi & Roberti (2011), *Operations Research* 59, 1269-1283 (ng-routes).
"""

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.dominance import dominated
from windopt.solving.exact.labels import (
    Bound,
    Ints,
    Labels,
    Memory,
    Prices,
    carried,
    price_of,
)
from windopt.solving.exact.network import SLACK, Floats, Side
from windopt.solving.exact.waiting_labels import Span, Waiting, empty_labels, enlist, in_use


@compiled
def _start(
    waiting: Waiting,
    side: Side,
    prices: Prices,
    memory: Memory,
    span: Span,
) -> None:
    """Fly from the station to each turbine."""
    for j in range(len(side.first)):
        if side.first[j] <= span.horizon and side.first[j] + side.rest[j] <= span.t_max + SLACK:
            new = waiting.row[1]
            waiting.T[new] = side.first[j]
            waiting.C[new] = side.first_cost[j] - prices.pi[j]
            waiting.V[new] = memory.bit[j, j]
            waiting.S[new] = prices.inside[j]
            waiting.parent[new], waiting.checked[new] = -1, -1
            enlist(waiting, new, int(side.first[j] / span.width), j)


@compiled
def _settle(
    found: Labels,
    waiting: Waiting,
    b: int,
    j: int,
    layer: int,
    count: int,
    keep: int,
    penalty: Floats,
    exact: bool,
    order: Ints,
) -> int:
    """Find the labels that wait at j in bucket b and are of use; return the number of all."""
    found.start[layer, j] = found.end[layer, j] = count
    m, a = 0, waiting.head[b, j]
    while a >= 0:
        order[m] = a
        m, a = m + 1, waiting.following[a]
    waiting.head[b, j] = -1
    waiting.number[b] -= m
    for a in order[:m][np.argsort(waiting.C[order[:m]])]:
        waiting.following[a], waiting.row[0] = waiting.row[0], a
        if count - found.start[layer, j] == keep or dominated(
            waiting.T[a], waiting.C[a], waiting.V[a], waiting.S, a, j, found,
            waiting.checked[a] + 1, layer, penalty, exact,
        ):  # fmt: skip
            continue
        if count == len(found.T):
            return count + 1
        found.T[count], found.C[count] = waiting.T[a], waiting.C[a]
        found.node[count], found.parent[count] = j, waiting.parent[a]
        found.V[count], found.S[count] = waiting.V[a], waiting.S[a]
        count += 1
        found.end[layer, j] = count
    return count


@compiled
def _settle_all(
    found: Labels,
    waiting: Waiting,
    b: int,
    layer: int,
    count: int,
    keep: int,
    penalty: Floats,
    exact: bool,
    order: Ints,
) -> int:
    """Settle the labels that wait in bucket b, at all turbines while there is room."""
    for j in range(found.start.shape[1]):
        count = _settle(found, waiting, b, j, layer, count, keep, penalty, exact, order)
        if count > len(found.T):
            break
    return count


@compiled
def _extend(
    found: Labels,
    waiting: Waiting,
    a: int,
    layer: int,
    side: Side,
    prices: Prices,
    memory: Memory,
    span: Span,
    exact: bool,
    bound: Bound,
) -> bool:
    """Fly on from label a; tell whether all new labels fitted."""
    i = found.node[a]
    for e in range(side.degree[i]):
        j = side.heads[i, e]
        t = found.T[a] + side.legs[i, j]
        if t > span.horizon or t + side.rest[j] > span.t_max + SLACK:
            continue
        if found.V[a] & memory.bit[i, j] != NONE:
            continue
        new = waiting.row[0] if waiting.row[0] >= 0 else waiting.row[1]
        if new == len(waiting.T):
            return False
        c = found.C[a] + side.legs_cost[i, j] - prices.pi[j]
        for word in range(waiting.S.shape[1]):
            kept = found.S[a, word] & prices.memory[i, j, word]
            c += price_of(kept & prices.inside[j, word], word, prices.penalty)
            waiting.S[new, word] = kept ^ prices.inside[j, word]
        if t >= bound.after:
            left = int((span.t_max - t + SLACK) / bound.step)
            if c + bound.table[j, left] > bound.limit:
                continue
        v = carried(found.V[a], i, j, memory) | memory.bit[j, j]
        if not dominated(
            t, c, v, waiting.S, new, j, found, 0, layer, prices.penalty, exact
        ):  # fmt: skip
            waiting.T[new], waiting.C[new], waiting.V[new] = t, c, v
            waiting.parent[new], waiting.checked[new] = a, layer
            enlist(waiting, new, int(t / span.width), j)
    return True


@compiled
def labels(
    side: Side,
    prices: Prices,
    memory: Memory,
    span: Span,
    exact: bool,
    keep: int,
    bound: Bound,
    capacity: int,
    stop: NDArray[np.uint8],
) -> tuple[Labels, bool]:
    """Return the labels of one side up to the horizon of ``span``, and whether they are complete.

    Parameters
    ----------
    exact
        Whether dominance respects V and S; without, flights are lost and time is saved.
    keep
        Labels of each turbine in each layer to keep; where there are more, flights are lost too.
    bound
        Drops labels that cannot end below its limit.
    capacity
        Labels to hold at most, not counting the first of each turbine.
    stop
        Set to non-zero by another thread to end the search.
    """
    found, waiting = empty_labels(capacity, prices.inside.shape, span)
    order = np.empty(len(found.T), np.int32)
    count, layer = 0, -1
    _start(waiting, side, prices, memory, span)
    for b in range(len(waiting.number)):
        while waiting.number[b] > 0:
            layer, first = layer + 1, count
            if layer == len(found.opens):
                return in_use(found, count, layer), False
            found.opens[layer] = b * span.width
            count = _settle_all(found, waiting, b, layer, count, keep, prices.penalty, exact, order)
            if count > len(found.T):
                return in_use(found, len(found.T), layer), False
            for a in range(first, count):
                if stop[0] != 0 or not _extend(
                    found, waiting, a, layer, side, prices, memory, span, exact, bound
                ):
                    return in_use(found, count, layer), False
    return in_use(found, count, layer + 1), True
