"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta.
"""

from windopt.solving.exact.branching import branch
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.relaxation import MARGIN, Fixing, Relaxation
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.tightening import tighten

SMALLER, SMALLEST = 0.5, 0.05
"""By what delta shrinks where flights are too many, and the part of the gap at which to give up."""


def close(
    relaxation: Relaxation, fixing: Fixing, reach: float, effort: int, search: Search
) -> float:
    """Close the gap with the flights within it, or as much of it as ``effort`` allows.

    Parameters
    ----------
    reach
        The delta to try first, where the gap is wider.
    effort
        Half flights to hold at most, for one side of one station; memory may allow fewer.

    Returns
    -------
    The delta whose flights were not too many, or the last that was tried.
    """
    gap = search.ceiling - fixing.value
    delta = min(reach, gap)
    while delta >= SMALLEST * gap:
        networks = fixing.useful(relaxation.pricer.networks, delta)
        pool = enumerate_flights(
            networks, fixing, delta, effort, relaxation.memory, search.clock, apart=search.limited
        )
        if pool is not None:
            _choose(pool, relaxation, fixing.value, delta, search)
            break
        search.note("too many flights within %.0f %% of the gap", 100 * delta / gap)
        delta *= SMALLER
    return delta


def _choose(pool: Pool, relaxation: Relaxation, value: float, delta: float, search: Search) -> None:
    """Look for a plan in ``pool``, all flights of a reduced cost up to ``delta``."""
    search.note("%d flights within %.3f of %.3f", len(pool), delta, value)
    _require_plan(pool, relaxation, delta, search)
    target = min(value + delta, search.ceiling)
    triples = relaxation.master.cuts.triples
    slices = pool.slices(search.n, search.clock)
    reduced = reduced_costs(pool, slices, relaxation.duals, triples, search.clock)
    keep = reduced <= delta + MARGIN
    pool, reduced = pool.kept(keep), reduced[keep]
    tight = tighten(pool, reduced, triples, relaxation.counts, target, search, search.prove)
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
