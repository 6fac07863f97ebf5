"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta.
"""

from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.relaxation import Fixing, Relaxation
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.staged_mip import staged_mip
from windopt.solving.exact.tightening import tighten

SMALLER, SMALLEST = 0.5, 0.1
"""By what the part of the gap shrinks where its flights are too many, and where to give up."""


def close(relaxation: Relaxation, fixing: Fixing, search: Search) -> None:
    """Close the gap with the flights within it, or as much of it as memory allows."""
    part = 1.0
    while part >= SMALLEST:
        delta = part * (search.ceiling - fixing.value)
        networks = fixing.useful(relaxation.pricer.networks, delta)
        pool = enumerate_flights(networks, fixing, delta, relaxation.memory, search.clock)
        if pool is None:
            part *= SMALLER
            continue
        _require_plan(pool, relaxation, delta, search)
        target = min(fixing.value + delta, search.ceiling)
        tight = tighten(pool, relaxation, target, search)
        if tight is not None:
            staged_mip(tight, relaxation.counts, target, search)
        return


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
