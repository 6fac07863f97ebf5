"""Branching over a pool: on how many flights are sent, and on who is visited together.

Most nodes end without a search of their own: the bound that tightening reaches in them leaves
no flight, or few enough for HiGHS. Nodes are taken in the order of their bounds, so the least of
those that are open bounds every plan.

* [1] Ryan & Foster (1981), in *Computer Scheduling of Public Transport*, 269-280.
"""

from dataclasses import replace
from heapq import heappop, heappush
from itertools import count

import numpy as np

from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.relaxation import MARGIN
from windopt.solving.exact.search import CLOSED, Search
from windopt.solving.exact.staged_mip import minimise, staged_mip
from windopt.solving.exact.tightening import Tightened, tighten

FRACTIONAL = 0.05
"""Distance from a whole number from which a number of flights is branched on."""


def branch(root: Tightened, counts: Floats, target: float, search: Search) -> None:
    """Find the best plan cheaper than ``target`` over what is left of a pool, or prove it none.

    Parameters
    ----------
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    """
    serial = count()
    nodes = [(root.value, next(serial), root, counts)]
    proved = target
    while nodes:
        value, _, node, counts = heappop(nodes)
        others = min([proved, *(open_node[0] for open_node in nodes)])

        def prove(bound: float, others: float = others) -> None:
            search.prove(min(bound, others, search.ceiling))

        prove(value)
        bound = max(value, staged_mip(node, counts, target, search, prove))
        prove(bound)
        wanted = min(target, search.ceiling)
        keep = node.reduced <= wanted - node.value + MARGIN
        if bound >= wanted - CLOSED or not keep.any():
            proved = min(proved, max(bound, wanted))
            continue
        pool, reduced = node.pool.kept(keep), node.reduced[keep]
        children = _children(replace(node, pool=pool), counts)
        if not children:
            bound = max(bound, minimise(pool, node.triples, counts, search))
            proved = min(proved, bound, wanted)
        for part, limits in children:
            child = tighten(
                pool.kept(part), reduced[part], node.triples, limits, wanted, search,
                prove=lambda _: None,
            )  # fmt: skip
            if child is not None:
                left = max(child.value, bound)
                search.note("node with %d flights above %.3f", len(child.pool), left)
                heappush(nodes, (left, next(serial), child, limits))
    search.prove(min(proved, search.ceiling))


def _children(node: Tightened, counts: Floats) -> list[tuple[Bools, Floats]]:
    """Return two parts of a node: flights that remain, and limits on how many are sent.

    There are none where nothing that could be branched on is fractional.
    """
    fraction = np.abs(node.sent - np.round(node.sent))
    everyone = np.ones(len(node.pool), bool)
    if fraction.max() > FRACTIONAL:
        which = int(fraction.argmax())
        fewer, more = counts.copy(), counts.copy()
        fewer[which, 1] = np.floor(node.sent[which])
        more[which, 0] = np.floor(node.sent[which]) + 1
        return [(everyone, fewer), (everyone, more)]
    undecided = np.abs(np.triu(node.together, 1) - 0.5) + np.tril(np.ones_like(node.together))
    i, j = np.unravel_index(undecided.argmin(), undecided.shape)
    if undecided[i, j] > 0.5 - FRACTIONAL:
        return []
    members = node.pool.members(len(undecided))
    first, second = members[:, i], members[:, j]
    return [(first == second, counts), (~(first & second), counts)]
