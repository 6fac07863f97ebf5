"""The staged program: branch and bound over few flights first, over more where these do not do.

A plan cheaper than bound + delta flies only flights of reduced cost up to delta, so the optimum
over those either is such a plan or proves bound + delta.
"""

import highspy
import numpy as np
from scipy.sparse import csr_array

from formulations.set_partitioning import set_partitioning
from windopt.solving.exact.network import Floats
from windopt.solving.exact.relaxation import MARGIN
from windopt.solving.exact.search import CLOSED, Search
from windopt.solving.exact.tightening import Tightened, flight_rows

SIZES = (2500, 5000, 9000, 16_000)
"""Flights of the stages but the last, which has all."""
WITH_ROWS = 10_000
"""Flights beyond which subset rows make the program slower."""


def staged_mip(tight: Tightened, counts: Floats, target: float, search: Search) -> None:
    """Look for a plan cheaper than ``target`` in what :func:`tighten` left, or prove it a bound."""
    order = np.argsort(tight.reduced, kind="stable")
    tight = Tightened(tight.pool.kept(order), tight.reduced[order], tight.triples, tight.value)
    for size in (*SIZES, len(order)):
        wanted = min(target, search.ceiling)
        matter = int(np.searchsorted(tight.reduced, wanted - tight.value + MARGIN, side="right"))
        last = matter <= 1.3 * size
        rows = matter if last else size
        delta = wanted if last else min(wanted, tight.value + float(tight.reduced[rows]) - MARGIN)
        _branch_and_bound(tight, rows, counts, delta, search)
        if last or search.closed:
            return


def _branch_and_bound(
    tight: Tightened, rows: int, counts: Floats, delta: float, search: Search
) -> None:
    """Minimise over the first ``rows`` flights; what it proves holds up to ``delta``."""
    if rows == 0:
        search.prove(delta)
        return
    pool = tight.pool.kept(np.arange(rows))
    triples = tight.triples if rows <= WITH_ROWS else tight.triples[:0]
    program = set_partitioning(search.n, counts)
    model = program.model
    program.add_subset_rows(csr_array((len(triples), 0)))
    program.add_flights(
        pool.cost, flight_rows(pool.members(search.n), pool.station, len(counts), triples)
    )
    model.setOptionValue("mip_rel_gap", 0.0)
    model.setOptionValue("mip_abs_gap", CLOSED)
    status = search.clock.minimise(model)
    info = model.getInfo()
    search.note("%d flights, %d nodes", rows, info.mip_node_count)
    if status == highspy.HighsModelStatus.kInfeasible:
        search.prove(delta)
        return
    if info.primal_solution_status == highspy.SolutionStatus.kSolutionStatusFeasible:
        x = np.array(model.getSolution().col_value)
        search.offer([(int(pool.station[r]), pool.path(int(r))) for r in np.flatnonzero(x > 0.5)])
    search.prove(min(info.mip_dual_bound, delta))
    search.clock.check()
