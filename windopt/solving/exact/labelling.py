"""Labelling: the partial flights of one station that no other one makes useless.

Labels of equal time are told apart by layers: a layer holds the labels of one time bucket and is
final when the next begins, because only legs shorter than a bucket stay in it, and those open a
layer of their own.

* [1] Baldacci, Mingozzi & Roberti (2011), *Operations Research* 59, 1269-1283 (ng-routes).
"""

from typing import NamedTuple

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
    Words,
    carried,
    price_of,
)
from windopt.solving.exact.network import SLACK, Floats, Side

LAYERS = 8
"""Layers of each time bucket, on average, at most."""


class Waiting(NamedTuple):
    """Labels found but not compared yet: a linked list for each bucket and turbine.

    Attributes
    ----------
    T, C, V, S, parent
        As of :class:`~windopt.solving.exact.labels.Labels`.
    checked
        Last layer that a label was compared with.
    following, head
        Next label of a list, and the first, shape ``(buckets, n)``; -1 at the end.
    number
        Labels waiting in each bucket.
    row
        The first row that was given back, or -1, and the first that was never used.
    """

    T: Floats
    C: Floats
    V: Words
    S: Words
    parent: Ints
    checked: Ints
    following: Ints
    head: Ints
    number: NDArray[np.int64]
    row: NDArray[np.int64]


@compiled
def _rooms(capacity: int, words: int, layers: int, buckets: int, n: int) -> tuple[Labels, Waiting]:
    """Make room for labels."""
    found = Labels(
        np.empty(capacity),
        np.empty(capacity),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.uint64),
        np.empty((capacity, words), np.uint64),
        np.zeros((layers, n), np.int32),
        np.zeros((layers, n), np.int32),
        np.empty(layers),
    )
    waiting = Waiting(
        np.empty(capacity),
        np.empty(capacity),
        np.empty(capacity, np.uint64),
        np.empty((capacity, words), np.uint64),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.full((buckets, n), -1, np.int32),
        np.zeros(buckets, np.int64),
        np.array([-1, 0]),
    )
    return found, waiting


@compiled
def _enlist(waiting: Waiting, new: int, b: int, j: int) -> None:
    """Let the label in row ``new`` wait at turbine j in bucket b."""
    if new == waiting.row[0]:
        waiting.row[0] = waiting.following[new]
    else:
        waiting.row[1] += 1
    waiting.following[new], waiting.head[b, j] = waiting.head[b, j], new
    waiting.number[b] += 1


@compiled
def _start(
    waiting: Waiting,
    side: Side,
    prices: Prices,
    memory: Memory,
    t_max: float,
    horizon: float,
    width: float,
) -> None:
    """Fly from the station to each turbine."""
    for j in range(len(side.first)):
        if side.first[j] <= horizon and side.first[j] + side.rest[j] <= t_max + SLACK:
            new = waiting.row[1]
            waiting.T[new] = side.first[j]
            waiting.C[new] = side.first[j] - prices.pi[j]
            waiting.V[new] = memory.bit[j, j]
            waiting.S[new] = prices.inside[j]
            waiting.parent[new], waiting.checked[new] = -1, -1
            _enlist(waiting, new, int(side.first[j] / width), j)


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
def _extend(
    found: Labels,
    waiting: Waiting,
    a: int,
    layer: int,
    side: Side,
    prices: Prices,
    memory: Memory,
    t_max: float,
    horizon: float,
    width: float,
    exact: bool,
    bound: Bound,
) -> bool:
    """Fly on from label a; tell whether all new labels fitted."""
    i = found.node[a]
    for e in range(side.degree[i]):
        j = side.heads[i, e]
        t = found.T[a] + side.legs[i, j]
        if found.V[a] & memory.bit[i, j] != NONE or t > horizon or t + side.rest[j] > t_max + SLACK:
            continue
        new = waiting.row[0] if waiting.row[0] >= 0 else waiting.row[1]
        if new == len(waiting.T):
            return False
        c = found.C[a] + side.legs[i, j] - prices.pi[j]
        for word in range(waiting.S.shape[1]):
            kept = found.S[a, word] & prices.memory[j, word]
            c += price_of(kept & prices.inside[j, word], word, prices.penalty)
            waiting.S[new, word] = kept ^ prices.inside[j, word]
        if t >= bound.after:
            left = int((t_max - t + SLACK) / bound.step)
            if c + bound.table[j, left] > bound.limit:
                continue
        v = carried(found.V[a], i, j, memory) | memory.bit[j, j]
        if not dominated(
            t, c, v, waiting.S, new, j, found, 0, layer, prices.penalty, exact
        ):  # fmt: skip
            waiting.T[new], waiting.C[new], waiting.V[new] = t, c, v
            waiting.parent[new], waiting.checked[new] = a, layer
            _enlist(waiting, new, int(t / width), j)
    return True


@compiled
def labels(
    side: Side,
    prices: Prices,
    memory: Memory,
    t_max: float,
    horizon: float,
    width: float,
    exact: bool,
    keep: int,
    bound: Bound,
    capacity: int,
    stop: NDArray[np.uint8],
) -> tuple[Labels, bool]:
    """Find the labels of one side up to a time ``horizon``.

    Parameters
    ----------
    width
        Width of a time bucket.
    exact
        Whether dominance respects V and S; without, flights are lost and time is saved.
    keep
        Labels to keep of each turbine in each layer, the cheapest; where it is fewer than there
        are, flights are lost as well.
    bound
        Drops labels that cannot end below its limit.
    capacity
        Labels to hold at most, not counting the first of each turbine.
    stop
        Set to non-zero by another thread to end the search.

    Returns
    -------
    The :class:`~windopt.solving.exact.labels.Labels`, and whether they are complete.
    """
    n, words = prices.memory.shape
    capacity = max(capacity, n)
    buckets = int(horizon / width) + 1
    layers = LAYERS * buckets + 1
    found, waiting = _rooms(capacity, words, layers, buckets, n)
    order = np.empty(capacity, np.int32)
    count, layer = 0, -1
    _start(waiting, side, prices, memory, t_max, horizon, width)
    for b in range(buckets):
        while waiting.number[b] > 0:
            layer, first = layer + 1, count
            if layer == layers:
                return _cut(found, count, layer), False
            found.opens[layer] = b * width
            for j in range(n):
                count = _settle(
                    found, waiting, b, j, layer, count, keep, prices.penalty, exact, order
                )
                if count > capacity:
                    return _cut(found, capacity, layer), False
            for a in range(first, count):
                if stop[0] != 0 or not _extend(
                    found, waiting, a, layer, side, prices, memory, t_max, horizon, width, exact,
                    bound,
                ):  # fmt: skip
                    return _cut(found, count, layer), False
    return _cut(found, count, layer + 1), True


@compiled
def _cut(found: Labels, count: int, layers: int) -> Labels:
    """Return copies of the rows in use."""
    return Labels(
        found.T[:count].copy(),
        found.C[:count].copy(),
        found.node[:count].copy(),
        found.parent[:count].copy(),
        found.V[:count].copy(),
        found.S[:count].copy(),
        found.start[:layers].copy(),
        found.end[:layers].copy(),
        found.opens[:layers].copy(),
    )
