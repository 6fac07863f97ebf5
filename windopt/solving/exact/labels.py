"""Labels: what is kept of partial flights, and of prices and neighbourhoods to make them.

A label ends at a turbine and remembers its time T, its cost C (that of its legs less the rewards of
its turbines), the turbines V it may not visit next (a subset of the last turbine's neighbourhood)
and the parities S of the subset-row cuts. :mod:`windopt.solving.exact.labelling` makes them.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, position
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.network import Floats

EPS = 1e-9
"""Below this, two times or two costs are the same."""

LABEL_BYTES = 40
"""Memory of one label, found or waiting, without the parities of its cuts."""

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
    memory
        The cuts that are remembered on the leg from turbine i to turbine j, as bits; shape
        ``(n, n, words)``.
    inside
        The cuts whose subset turbine i is in, shape ``(n, words)``.
    """

    pi: Floats
    penalty: Floats
    memory: Words
    inside: Words


def turned(prices: Prices) -> Prices:
    """Return the prices of legs flown the other way."""
    return prices._replace(memory=np.ascontiguousarray(prices.memory.transpose(1, 0, 2)))


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
    """What a label needs at least to end its flight, from :mod:`windopt.solving.exact.completions`.

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


@inlined
def recalled(S: Words, row: int, prices: Prices, i: int, j: int, into: Words) -> None:
    """Write what of the parities ``S[row]`` is remembered on the leg from i to j into row 0."""
    for word in range(S.shape[1]):
        into[0, word] = S[row, word] & prices.memory[i, j, word]


def path(node: Ints, parent: Ints, label: int) -> tuple[int, ...]:
    """Return the turbines on the way to a label, in the order of its side."""
    turbines = []
    while label >= 0:
        turbines.append(int(node[label]))
        label = int(parent[label])
    return tuple(reversed(turbines))
