"""Arc fixing: legs that no flight of interest uses, and what the rest of a flight costs at least.

Half labels give a table of the least cost of reaching each turbine by a given time; it lets
labels go on beyond half of t_max where they may still matter, and the tables of these hold for
every time. A leg is of no use when the best flight over it costs more than the gap [1].

* [1] Irnich, Desaulniers, Desrosiers & Hadjar (2010), *INFORMS Journal on Computing* 22, 297-313.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.joins import cheapest, partner
from windopt.solving.exact.labelling import labels
from windopt.solving.exact.labels import (
    EPS,
    UNBOUNDED,
    Bound,
    Labels,
    Memory,
    Prices,
    carried,
)
from windopt.solving.exact.network import SLACK, Floats, Network, Side
from windopt.solving.exact.waiting_labels import Span

STEPS = 540
"""Steps of time in a table."""


class Completions(NamedTuple):
    """Least cost of the rest of a flight, seen by forward and by backward labels.

    Attributes
    ----------
    forward, backward
        By turbine and time left, shape ``(n, steps)``; the turbine's own reward is not in it.
    step
        Width of a step.
    ahead, behind
        The forward and backward labels themselves, as far as they matter.
    """

    forward: Floats
    backward: Floats
    step: float
    ahead: Labels
    behind: Labels


@compiled
def _reached(found: Labels, side: Side, t_max: float, step: float) -> Floats:
    """Return the least cost of arriving at each turbine by each time, its own reward left out."""
    n, steps = len(side.first), int(t_max / step) + 2
    table = np.full((n, steps), np.inf)
    for j in range(n):
        if side.first[j] <= t_max:
            table[j, int(side.first[j] / step)] = side.first[j]
    for a in range(len(found.T)):
        i = found.node[a]
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            t = found.T[a] + side.legs[i, j]
            if t <= t_max + SLACK:
                q = int(t / step)
                table[j, q] = min(table[j, q], found.C[a] + side.legs[i, j])
    for j in range(n):
        for q in range(1, steps):
            table[j, q] = min(table[j, q], table[j, q - 1])
    return table


@compiled
def _through(
    ahead: Labels,
    behind: Labels,
    side: Side,
    memory: Memory,
    penalty: Floats,
    t_max: float,
    rest: Floats,
    step: float,
    pi: Floats,
    limit: float,
    stop: NDArray[np.uint8],
) -> Floats:
    """Return the least cost of a flight over each leg, ``inf`` beyond ``limit``."""
    n = len(side.first)
    cost = np.full((n, n), np.inf)
    least = cheapest(behind)
    for a in range(len(ahead.T)):
        if stop[0] != 0:
            break
        i = ahead.node[a]
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            so_far = ahead.C[a] + side.legs[i, j]
            left = t_max - ahead.T[a] - side.legs[i, j] + SLACK
            below = min(cost[i, j], limit) - so_far + EPS
            if left < 0.0 or rest[j, int(left / step)] - pi[j] >= below:
                continue
            if ahead.V[a] & memory.bit[i, j] != NONE:
                continue
            V = carried(ahead.V[a], i, j, memory)
            best, b = partner(behind, least, j, V, ahead.S, a, left, below, -np.inf, penalty)
            if b >= 0:
                cost[i, j] = so_far + best
    return cost


class Labelling(NamedTuple):
    """One station's network and what its labels are made from, for both sides alike.

    Attributes
    ----------
    network
        Its times are in thousandths of the longest t_max.
    prices, memory
        As of :class:`~windopt.solving.exact.labels.Prices` and
        :class:`~windopt.solving.exact.labels.Memory`.
    width
        Width of a time bucket, in the network's unit.
    capacity
        Labels of one side to hold at most.
    stop
        Shape ``(1,)``; non-zero ends the making.
    """

    network: Network
    prices: Prices
    memory: Memory
    width: float
    capacity: int
    stop: NDArray[np.uint8]


def _both(
    given: Labelling, horizon: float, bounds: tuple[Bound, Bound]
) -> tuple[Labels, Labels] | None:
    """Return the forward and backward labels up to ``horizon``; None where they are too many."""
    network, found = given.network, []
    span = Span(network.t_max, horizon, given.width)
    for side, bound in zip((network.forward, network.backward), bounds, strict=True):
        part, complete = labels(
            side, given.prices, given.memory, span, True, given.capacity, bound, given.capacity,
            given.stop,
        )  # fmt: skip
        if not complete:
            return None
        found.append(part)
    return found[0], found[1]


def _tables(network: Network, ahead: Labels, behind: Labels) -> tuple[Floats, Floats]:
    """Return the completion costs of forward and of backward labels."""
    t_max, step = network.t_max, network.t_max / STEPS
    return (
        _reached(behind, network.backward, t_max, step),
        _reached(ahead, network.forward, t_max, step),
    )


def useful_arcs(
    network: Network,
    prices: Prices,
    memory: Memory,
    width: float,
    limit: float,
    capacity: int,
    clock: Clock,
) -> tuple[Completions, Floats] | None:
    """Find the legs of one station on which a flight of cost ``limit`` or less may fly.

    Returns
    -------
    The tables of completion costs and the least cost of a flight over each leg, shape
    ``(n, n)``; None where there are more labels than ``capacity``.
    """
    given = Labelling(network, prices, memory, width, capacity, clock.stop)
    t_max, step = network.t_max, network.t_max / STEPS
    halves = _both(given, network.half, (UNBOUNDED, UNBOUNDED))
    if halves is None:
        return None
    tables = _tables(network, *halves)
    forward, backward = (Bound(table, step, network.half, limit) for table in tables)
    wholes = _both(given, t_max, (forward, backward))
    if wholes is None:
        return None
    rest = Completions(*_tables(network, *wholes), step, *wholes)
    through = _through(
        *wholes, network.forward, memory, prices.penalty, t_max, rest.forward, step, prices.pi,
        limit, clock.stop,
    )  # fmt: skip
    return rest, through
