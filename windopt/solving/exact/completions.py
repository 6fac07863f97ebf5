"""Completions: what the rest of a flight costs at least, told by labels from the other end.

Labels that know of no cut and remember few turbines are made quickly: first those up to half of
t_max, then, dropped by what these tell, those up to t_max. A label that knows of cuts ends its
flight for no less than one that does not, so tables of the costs of the latter drop most labels
long before these end.
"""

from typing import NamedTuple

import numpy as np

from windopt.solving.exact.both_sides import BothSides
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Bound, Labels
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
            table[j, int(side.first[j] / step)] = side.first_cost[j]
    for a in range(len(found.T)):
        i = found.node[a]
        for e in range(side.degree[i]):
            j = side.heads[i, e]
            t = found.T[a] + side.legs[i, j]
            if t <= t_max + SLACK:
                q = int(t / step)
                table[j, q] = min(table[j, q], found.C[a] + side.legs_cost[i, j])
    for j in range(n):
        for q in range(1, steps):
            table[j, q] = min(table[j, q], table[j, q - 1])
    return table


def tables(network: Network, ahead: Labels, behind: Labels) -> tuple[Floats, Floats, float]:
    """Return the completion costs of forward and of backward labels, and the step of time."""
    t_max, step = network.t_max, network.t_max / STEPS
    forward = _reached(behind, network.backward, t_max, step)
    return forward, _reached(ahead, network.forward, t_max, step), step


def told_by(found: list[Labels], given: BothSides, limits: Floats, *, whole: bool) -> list[Bound]:
    """Return what each side's labels need at least to end their flights, told by the other side's.

    Parameters
    ----------
    found
        Forward and backward labels, station by station.
    limits
        Cost that no flight of interest exceeds, by station.
    whole
        Whether the labels go on to t_max; those of half of it complete no shorter labels.
    """
    found_tables = given.clock.map(tables, given.networks, found[::2], found[1::2])
    told = []
    for network, limit, each in zip(given.networks, limits, found_tables, strict=True):
        forward, backward, step = each
        after = 0.0 if whole else network.half
        told += [Bound(table, step, after, limit) for table in (forward, backward)]
    return told


def completion_bounds(loose: BothSides, limits: Floats) -> list[Bound] | None:
    """Return what labels of each side need at least, whatever cuts they are charged for.

    Parameters
    ----------
    loose
        Without cuts, and with small neighbourhoods.
    limits
        Cost that no flight of interest exceeds, by station.

    Returns
    -------
    A bound for each side; None where memory does not suffice to find them.
    """
    found, complete = loose.labels(loose.unbounded)
    if complete:
        first = told_by(found, loose, limits, whole=False)
        del found  # labels take memory
        found, complete = loose.labels(first, whole=True)
    return told_by(found, loose, limits, whole=True) if complete else None


def tightest(one: Bound, other: Bound) -> Bound:
    """Return what both bounds say of the same side.

    Parameters
    ----------
    one
        Holds at every time.
    other
        Holds from some time on, with the same steps and the same limit.
    """
    least = one.step * (
        1 + np.arange(one.table.shape[1])
    )  # a label in step q has less than q + 1 steps left
    holds = least <= one.step * STEPS - other.after
    return one._replace(table=np.where(holds, np.maximum(one.table, other.table), one.table))
