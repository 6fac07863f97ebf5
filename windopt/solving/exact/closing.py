"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta.
"""

from windopt.solving.exact.branching import branch
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.relaxation import MARGIN, Fixing, Relaxation
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.tightening import tighten


def close(
    relaxation: Relaxation, fixing: Fixing, delta: float, effort: int, search: Search
) -> bool:
    """Find the best plan of flights of a reduced cost up to ``delta``, or prove there is none.

    Parameters
    ----------
    effort
        Half flights to hold at most, for one side of one station; memory may allow fewer.

    Returns
    -------
    Whether the flights were not too many.
    """
    if search.closed:
        return True
    delta = min(delta, search.ceiling - fixing.value)
    networks = fixing.useful(relaxation.pricer.networks, delta)
    pool = enumerate_flights(
        networks, fixing, delta, effort, relaxation.memory, search.clock, apart=search.limited
    )
    if pool is None:
        search.note("too many flights within %.3f of %.3f", delta, fixing.value)
        return False
    _choose(pool, relaxation, fixing, delta, search)
    return True


def _choose(
    pool: Pool, relaxation: Relaxation, fixing: Fixing, delta: float, search: Search
) -> None:
    """Look for a plan in ``pool``, all flights of a reduced cost up to ``delta``."""
    value = fixing.value
    search.note("%d flights within %.3f of %.3f", len(pool), delta, value)
    _require_plan(pool, relaxation, delta, search)
    target = min(value + delta, search.ceiling)
    rows = Rows.subsets(relaxation.master.cuts.triples)
    slices = pool.slices(search.n, search.clock)
    reduced = reduced_costs(pool, slices, relaxation.duals, rows, search.clock)
    keep = reduced <= delta + MARGIN
    pool, reduced = pool.kept(keep), reduced[keep]
    tight = tighten(pool, reduced, rows, relaxation.counts, target, search, search.prove)
    if tight is not None:
        search.note("%d flights left above %.3f", len(tight.pool), tight.value)
        branch(tight, relaxation.counts, target, search)


def _require_plan(pool: Pool, relaxation: Relaxation, delta: float, search: Search) -> None:
    """Check that those flights of the best plan are in the pool which must be.

    Raises
    ------
    ProofError
        If one is not: then the search for flights loses some.
    """
    for d, path in search.flights:
        time = search.networks[d].duration(path)
        if relaxation.reduced_cost(d, path) <= delta and not pool.holds(path, time):
            raise ProofError(f"The flight {path} from station {d} is not in the pool.")
