"""The staged program: HiGHS over few flights first, over more where these do not do.

A plan cheaper than bound + delta flies only flights of reduced cost up to delta, so the optimum
over those either is such a plan or proves bound + delta.
"""

from collections.abc import Callable, Iterator
from itertools import count

import highspy
import numpy as np
from scipy.sparse import csr_array

from formulations.set_partitioning import set_partitioning
from windopt.solving.exact.fixing import MARGIN
from windopt.solving.exact.network import Floats
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.search import CLOSED, Search
from windopt.solving.exact.selection import flight_rows
from windopt.solving.exact.tightening import Tightened

SIZES = (2500, 5000)
"""Flights of each stage; the last takes what is little more, and is left out if there is more."""
LITTLE_MORE = 1.3
LARGER = 2
"""What each stage is of the one before it, where they go on to the end."""
NODES = 300
"""Nodes after which HiGHS leaves the rest to branching, which adds rows in each node."""
PATIENCE, LEAST_PATIENCE = 0.1, 5.0
"""Part of the time so far that HiGHS gets for them, and the least [s]; so that branching depends on
the machine where HiGHS is long over its root."""


def staged_mip(
    tight: Tightened,
    counts: Floats,
    target: float,
    search: Search,
    prove: Callable[[float], None],
    to_the_end: bool = False,
) -> float:
    """Look for a plan cheaper than ``target`` among the flights that ``tighten`` left.

    Parameters
    ----------
    prove
        Told of each bound on such plans.
    to_the_end
        Whether to go on however many flights there are.

    Returns
    -------
    A bound on all such plans, at most ``target``.
    """
    order = np.argsort(tight.reduced, kind="stable")
    pool, reduced = tight.pool.kept(order), tight.reduced[order]
    bound = tight.value
    for size in _sizes(len(pool), to_the_end):
        wanted = min(target, search.ceiling)
        matter = int(np.searchsorted(reduced, wanted - tight.value + MARGIN, side="right"))
        whole = matter <= LITTLE_MORE * size
        rows = matter if whole else size
        delta = wanted if whole else min(wanted, tight.value + float(reduced[rows]) - MARGIN)
        part = pool.kept(np.arange(rows))
        nodes = None if to_the_end else NODES
        bound = max(bound, min(delta, minimise(part, tight.rows, counts, search, nodes)))
        prove(bound)
        if whole or bound >= search.ceiling - CLOSED:
            break
    return bound


def _sizes(flights: int, to_the_end: bool) -> Iterator[int]:
    """Yield the size of each stage; ever larger ones where it goes to the end."""
    if to_the_end:
        yield from (SIZES[0] * LARGER**stage for stage in count())
    elif flights <= LITTLE_MORE * SIZES[-1]:
        yield from SIZES
    else:
        yield SIZES[0]


def minimise(
    pool: Pool, rows: Rows, counts: Floats, search: Search, nodes: int | None = None
) -> float:
    """Offer the search the best plan found over ``pool``; return the bound on any such plan.

    Parameters
    ----------
    rows
        Rank-one rows, which plans keep anyway, to tighten the program.
    nodes
        After which to stop; by default when the plan is proved.
    """
    if not len(pool):
        return np.inf
    program = set_partitioning(search.n, counts, price=search.forfeit if search.partial else None)
    model = program.model
    before = model.getNumCol()
    program.add_entry_rows(csr_array(search.crowded.left_out[:, :before]), search.crowded.need)
    program.add_subset_rows(csr_array((rows.m, before)))
    members = pool.members(search.n)
    coefficients = flight_rows(members, pool.station, len(counts), rows, search.crowded)
    program.add_flights(pool.cost, coefficients)
    model.setOptionValue("mip_rel_gap", 0.0)
    model.setOptionValue("mip_abs_gap", CLOSED)
    patience = np.inf
    if nodes is not None:
        model.setOptionValue("mip_max_nodes", nodes)
        patience = max(LEAST_PATIENCE, PATIENCE * search.clock.elapsed)
    status = search.clock.minimise(model, patience)
    info = model.getInfo()
    search.note("%d flights, %d nodes", len(pool), info.mip_node_count)
    if status == highspy.HighsModelStatus.kInfeasible:
        return np.inf
    if info.primal_solution_status == highspy.SolutionStatus.kSolutionStatusFeasible:
        x = np.array(model.getSolution().col_value)[before:]
        search.offer([(int(pool.station[r]), pool.path(int(r))) for r in np.flatnonzero(x > 0.5)])
    search.clock.check()
    return float(info.mip_dual_bound)
