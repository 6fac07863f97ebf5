"""Labels: the partial flights of one station that no other one makes useless.

A label ends at a turbine and remembers its time T, its reduced cost C = T - sum of duals, the
turbines V it may not visit next (a subset of the last turbine's neighbourhood) and the parities
S of the subset-row cuts. Labels of equal time are told apart by layers: a layer holds the labels
of one time bucket and is final when the next begins, because only legs shorter than a bucket
stay in it, and those open a layer of their own.

* [1] Baldacci, Mingozzi & Roberti (2011), *Operations Research* 59, 1269-1283 (ng-routes).
* [2] Jepsen, Petersen, Spoorendonk & Pisinger (2008), *Operations Research* 56, 497-511
  (dominance with subset-row cuts).
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, position
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.network import SLACK, Floats, Side

EPS = 1e-9
"""Below this, two times or two costs are the same."""

LABEL_BYTES = 300
"""Memory of one label, found and waiting, with two searches at a time and some cuts."""

Words = NDArray[np.uint64]
Ints = NDArray[np.int32]


class Prices(NamedTuple):
    """What the master's duals ask of a flight.

    Attributes
    ----------
    pi
        Reward of each turbine, shape ``(n,)``.
    penalty
        Price of each active cut, shape ``(64 words,)``, not negative.
    memory, inside
        The cuts that are remembered at turbine i, and those whose subset it is in, as bits;
        shape ``(n, words)``.
    """

    pi: Floats
    penalty: Floats
    memory: Words
    inside: Words


class Memory(NamedTuple):
    """Ng-neighbourhoods in local numbers, so that a set of turbines is one word.

    Attributes
    ----------
    bit
        ``bit[i, j]``: the bit of turbine j among the neighbours of i, zero for others.
    member
        ``member[i, b]``: the neighbour of i whose bit is b.
    """

    bit: Words
    member: Ints


class Bound(NamedTuple):
    """What a label needs at least to end its flight, from :mod:`windopt.solving.exact.arc_fixing`.

    Attributes
    ----------
    table
        Least cost of the rest of a flight, shape ``(n, steps)``, by turbine and time left.
    step
        Width of a step of the table.
    after
        Time from which the table holds.
    limit
        Reduced cost that no flight of interest exceeds.
    """

    table: Floats
    step: float
    after: float
    limit: float


UNBOUNDED = Bound(np.zeros((1, 1)), 1.0, np.inf, np.inf)
"""A bound that drops no label."""


class Labels(NamedTuple):
    """Labels, layer by layer and turbine by turbine, cheapest first.

    Attributes
    ----------
    T, C, node, parent, V, S
        One row per label; ``parent`` is -1 at the start of a flight.
    start, end
        The labels of layer l at turbine i are rows ``start[l, i]`` to ``end[l, i]``.
    opens
        Time at which each layer's bucket begins.
    """

    T: Floats
    C: Floats
    node: Ints
    parent: Ints
    V: Words
    S: Words
    start: Ints
    end: Ints
    opens: Floats


@compiled
def carried(V: np.uint64, i: int, j: int, memory: Memory) -> np.uint64:
    """Return what of V, remembered at i, is remembered at j."""
    kept = NONE
    while V != NONE:
        lowest = V & (~V + ONE)
        V ^= lowest
        kept |= memory.bit[j, memory.member[i, position(lowest)]]
    return kept


@compiled
def price_of(bits: np.uint64, word: int, penalty: Floats) -> float:
    """Return the price of the cuts whose bits are set in one word."""
    price = 0.0
    while bits != NONE:
        lowest = bits & (~bits + ONE)
        bits ^= lowest
        price += penalty[word * 64 + position(lowest)]
    return price


@compiled
def _dominated(
    T: float,
    C: float,
    V: np.uint64,
    S: Words,
    at: int,
    j: int,
    found: Labels,
    first_layer: int,
    last_layer: int,
    penalty: Floats,
    exact: bool,
) -> bool:
    """Tell whether a found label at j makes the one with parities ``S[at]`` useless."""
    for layer in range(first_layer, last_layer + 1):
        for a in range(found.start[layer, j], found.end[layer, j]):
            slack = C - found.C[a] + EPS
            if slack < 0.0:
                break
            if found.T[a] > T + EPS:
                continue
            if not exact:
                return True
            if found.V[a] & ~V != NONE:
                continue
            for word in range(S.shape[1]):
                slack -= price_of(found.S[a, word] & ~S[at, word], word, penalty)
                if slack < 0.0:
                    break
            if slack >= 0.0:
                return True
    return False


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
        Labels to hold at most.
    stop
        Set to non-zero by another thread to end the search.

    Returns
    -------
    The :class:`Labels`, and whether they are complete.
    """
    n, words = prices.memory.shape
    buckets = int(horizon / width) + 1
    layers = 8 * buckets + 1
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
    # Candidates wait in a linked list for each bucket and turbine; `free` strings unused rows.
    T = np.empty(capacity)
    C = np.empty(capacity)
    V = np.empty(capacity, np.uint64)
    S = np.empty((capacity, words), np.uint64)
    parent = np.empty(capacity, np.int32)
    checked = np.empty(capacity, np.int32)
    following = np.empty(capacity, np.int32)
    head = np.full((buckets, n), -1, np.int32)
    waiting = np.zeros(buckets, np.int64)
    free, used, count, layer = -1, 0, 0, -1
    order = np.empty(capacity, np.int32)

    for j in range(n):
        if side.first[j] <= horizon and side.first[j] + side.rest[j] <= t_max + SLACK:
            T[used] = side.first[j]
            C[used] = side.first[j] - prices.pi[j]
            V[used] = memory.bit[j, j]
            S[used] = prices.inside[j]
            parent[used], checked[used] = -1, -1
            b = int(T[used] / width)
            following[used], head[b, j] = head[b, j], used
            waiting[b] += 1
            used += 1

    for b in range(buckets):
        while waiting[b] > 0:
            layer += 1
            if layer == layers or stop[0] != 0:
                return _cut(found, count, layer), False
            found.opens[layer] = b * width
            for j in range(n):
                found.start[layer, j] = found.end[layer, j] = count
                m, a = 0, head[b, j]
                while a >= 0:
                    order[m] = a
                    m, a = m + 1, following[a]
                head[b, j] = -1
                waiting[b] -= m
                for a in order[:m][np.argsort(C[order[:m]])]:
                    following[a], free = free, a
                    if count - found.start[layer, j] == keep or _dominated(
                        T[a], C[a], V[a], S, a, j, found, checked[a] + 1, layer,
                        prices.penalty, exact,
                    ):  # fmt: skip
                        continue
                    if count == capacity:
                        return _cut(found, count, layer), False
                    found.T[count] = T[a]
                    found.C[count] = C[a]
                    found.node[count] = j
                    found.parent[count] = parent[a]
                    found.V[count] = V[a]
                    found.S[count] = S[a]
                    count += 1
                    found.end[layer, j] = count

            for a in range(found.start[layer, 0], count):
                if stop[0] != 0:
                    return _cut(found, count, layer), False
                i = found.node[a]
                for e in range(side.degree[i]):
                    j = side.heads[i, e]
                    if found.V[a] & memory.bit[i, j] != NONE:
                        continue
                    t = found.T[a] + side.legs[i, j]
                    if t > horizon or t + side.rest[j] > t_max + SLACK:
                        continue
                    new = free if free >= 0 else used
                    if new == capacity:
                        return _cut(found, count, layer), False
                    c = found.C[a] + side.legs[i, j] - prices.pi[j]
                    for word in range(words):
                        kept = found.S[a, word] & prices.memory[j, word]
                        c += price_of(kept & prices.inside[j, word], word, prices.penalty)
                        S[new, word] = kept ^ prices.inside[j, word]
                    if t >= bound.after:
                        left = int((t_max - t + SLACK) / bound.step)
                        if c + bound.table[j, left] > bound.limit:
                            continue
                    v = carried(found.V[a], i, j, memory) | memory.bit[j, j]
                    if _dominated(t, c, v, S, new, j, found, 0, layer, prices.penalty, exact):
                        continue
                    if free >= 0:
                        free = following[free]
                    else:
                        used += 1
                    T[new], C[new], V[new] = t, c, v
                    parent[new], checked[new] = a, layer
                    bucket = int(t / width)
                    following[new], head[bucket, j] = head[bucket, j], new
                    waiting[bucket] += 1
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


def path(node: Ints, parent: Ints, label: int) -> tuple[int, ...]:
    """Return the turbines on the way to a label, in the order of its side."""
    turbines = []
    while label >= 0:
        turbines.append(int(node[label]))
        label = int(parent[label])
    return tuple(reversed(turbines))
