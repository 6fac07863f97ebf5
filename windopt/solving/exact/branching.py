"""Branching over a pool: on how many flights are sent, and on who is visited together.

Most nodes end without a search of their own: the bound that tightening reaches in them leaves
no flight, or few enough for HiGHS. Nodes are taken in the order of their bounds, so the least of
those that are open bounds every plan.

* [1] Ryan & Foster (1981), in *Computer Scheduling of Public Transport*, 269-280.
"""

from collections.abc import Callable
from functools import partial
from heapq import heappop, heappush
from itertools import count
from typing import NamedTuple

import numpy as np

from windopt.solving.exact.fixing import MARGIN
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.search import CLOSED, Search
from windopt.solving.exact.staged_mip import LITTLE_MORE, SIZES, staged_mip
from windopt.solving.exact.tightening import Tightened, tighten

MOST = int(LITTLE_MORE * SIZES[-1])
"""Flights that a node may leave to HiGHS."""
SMALL = 500
"""Flights few enough to leave a branch to HiGHS; it works alone, while branches are tightened side
by side."""
PAIRS = 6
"""Pairs of turbines to try branching on."""
ITERATIONS = 100
"""Of the dual simplex method at most to tell how much a branch raises the bound."""
LEAST_GAIN = 1e-3
"""What a branch counts as raising the bound at least."""
FRACTIONAL = 0.05
"""Distance from a whole number from which a number of flights is branched on."""
UNDECIDED = 1e-6
"""Distance from 0 and 1 from which a pair is neither apart nor together."""


class Branch(NamedTuple):
    """Which flights remain, told from their turbines, and limits on how many are sent."""

    part: Callable[[Bools], Bools]
    counts: Floats


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
        search.nodes += 1
        others = min([proved, *(open_node[0] for open_node in nodes)])

        def prove(bound: float, others: float = others) -> None:
            search.prove(min(bound, others, search.ceiling))

        prove(value)
        bound = value
        if len(node.pool) <= MOST:
            bound = max(value, staged_mip(node, counts, target, search, prove))
        prove(bound)
        wanted = min(target, search.ceiling)
        keep = node.reduced <= wanted - node.value + MARGIN
        if bound >= wanted - CLOSED or not keep.any():
            proved = min(proved, max(bound, wanted))
            continue
        pool, reduced = node.pool.kept(keep), node.reduced[keep]
        children = _children(node, counts, wanted, search)
        if not children:  # the solution is a plan, made of a few flights of no reduced cost
            listed = staged_mip(node, counts, target, search, prove, to_the_end=True)
            proved = min(proved, max(bound, listed), wanted)
            continue
        for child, limits in _tightened(children, pool, reduced, node.rows, wanted, search, prove):
            left = max(child.value, bound)
            search.note("node with %d flights above %.3f", len(child.pool), left)
            if len(child.pool):
                heappush(nodes, (left, next(serial), child, limits))
    search.prove(min(proved, search.ceiling))


def _tightened(
    branches: list[Branch],
    pool: Pool,
    reduced: Floats,
    rows: Rows,
    target: float,
    search: Search,
    prove: Callable[[float], None],
) -> list[tuple[Tightened, Floats]]:
    """Return what is left of each branch, all tightened side by side."""
    members = pool.members(search.n)
    bounds = np.full(len(branches), -np.inf)

    def tightened(which: int, branch: Branch) -> tuple[Tightened, Floats]:
        part = branch.part(members)
        reached = partial(bounds.__setitem__, which)
        left = tighten(
            pool.kept(part), reduced[part], rows, branch.counts, target, search, reached, SMALL
        )
        return left, branch.counts

    try:
        left: list[tuple[Tightened, Floats]] = search.clock.side_by_side(
            tightened, range(len(branches)), branches
        )
    finally:
        prove(float(bounds.min(initial=target)))
    return left


def _children(node: Tightened, counts: Floats, target: float, search: Search) -> list[Branch]:
    """Return the two branches that raise the bound most, and none where no question is open."""
    members = node.selection.members
    candidates = _on_counts(node.sent, counts)
    for branches in _on_pairs(node.together, counts):
        if not any(branch.part(members).all() for branch in branches):
            candidates.append(branches)
    if len(candidates) < 2:
        return candidates[0] if candidates else []

    def gain(branch: Branch) -> float:
        value = node.selection.value_with(
            branch.part(members), branch.counts, ITERATIONS, search.clock
        )
        return max(min(value, target) - node.value, LEAST_GAIN)

    gains = [[gain(branch) for branch in branches] for branches in candidates]
    best = int(np.argmax(np.prod(gains, axis=1)))
    search.note("branching gains %s", np.round(gains[best], 2))
    return candidates[best]


def _on_counts(sent: Floats, counts: Floats) -> list[list[Branch]]:
    """Return branches on the numbers of flights that are fractional."""
    candidates: list[list[Branch]] = []
    for which in np.flatnonzero(np.abs(sent - np.round(sent)) > FRACTIONAL):
        fewer, more = counts.copy(), counts.copy()
        fewer[which, 1] = np.floor(sent[which])
        more[which, 0] = np.floor(sent[which]) + 1
        candidates.append([Branch(everything, fewer), Branch(everything, more)])
    return candidates


def _on_pairs(together: Floats, counts: Floats) -> list[list[Branch]]:
    """Return branches on pairs of turbines that are neither together nor apart."""
    undecided = np.abs(np.triu(together, 1) - 0.5) + np.tril(np.ones_like(together))
    candidates: list[list[Branch]] = []
    for pair in np.argsort(undecided, axis=None, kind="stable")[:PAIRS]:
        i, j = np.unravel_index(pair, undecided.shape)
        if undecided[i, j] <= 0.5 - UNDECIDED:
            both = Branch(partial(as_one, i, j), counts), Branch(partial(apart, i, j), counts)
            candidates.append([*both])
    return candidates


def everything(members: Bools) -> Bools:
    """Keep all flights."""
    return np.ones(len(members), bool)


def as_one(i: int, j: int, members: Bools) -> Bools:
    """Keep the flights that visit both i and j or neither."""
    same: Bools = members[:, i] == members[:, j]
    return same


def apart(i: int, j: int, members: Bools) -> Bools:
    """Keep the flights that do not visit both i and j."""
    return ~(members[:, i] & members[:, j])
