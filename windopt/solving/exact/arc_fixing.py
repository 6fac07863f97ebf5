"""Arc fixing: legs that no flight of interest uses, and what the rest of a flight costs at least.

Half labels give a table of the least cost of reaching each turbine by a given time; it lets
labels go on beyond half of t_max where they may still matter, and the tables of these hold for
every time. A leg is of no use when the best flight over it costs more than the gap [1]_.

.. [1] Irnich, Desaulniers, Desrosiers & Hadjar (2010), *INFORMS Journal on Computing* 22, 297-313.
"""

from typing import NamedTuple

import numpy as np

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Bound, Labels, Memory, Prices, labels
from windopt.solving.exact.network import SLACK, Floats, Network, Side

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
    """

    forward: Floats
    backward: Floats
    step: float


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
    found: Labels, side: Side, pi: Floats, rest: Floats, t_max: float, step: float
) -> Floats:
    """Return the least cost of a flight over each leg, shape ``(n, n)``."""
    n = len(side.first)
    cost = np.full((n, n), np.inf)
    for a in range(len(found.T)):
        i = found.node[a]
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            t = found.T[a] + side.legs[i, j]
            if t <= t_max + SLACK:
                ends = rest[j, int((t_max - t + SLACK) / step)]
                cost[i, j] = min(cost[i, j], found.C[a] + side.legs[i, j] - pi[j] + ends)
    return cost


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
    step = network.t_max / STEPS

    def searched(side: Side, horizon: float, bound: Bound) -> Labels | None:
        found, complete = labels(
            side, prices, memory, network.t_max, horizon, width, True, bound, capacity, clock.stop
        )
        return found if complete else None

    def tables(bounds: tuple[Bound, Bound], horizon: float) -> tuple[Labels, Completions] | None:
        ahead = searched(network.forward, horizon, bounds[0])
        behind = searched(network.backward, horizon, bounds[1]) if ahead else None
        if ahead is None or behind is None:
            return None
        completions = Completions(
            _reached(behind, network.backward, network.t_max, step),
            _reached(ahead, network.forward, network.t_max, step),
            step,
        )
        return ahead, completions

    nothing = Bound(np.zeros((1, 1)), 1.0, np.inf, np.inf)
    halves = tables((nothing, nothing), network.half)
    if halves is None:
        return None
    _, rest = halves
    bounds = tuple(
        Bound(table, step, network.half, limit) for table in (rest.forward, rest.backward)
    )
    wholes = tables((bounds[0], bounds[1]), network.t_max)
    if wholes is None:
        return None
    ahead, rest = wholes
    cost = _through(ahead, network.forward, prices.pi, rest.forward, network.t_max, step)
    return rest, cost
