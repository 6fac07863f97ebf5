"""Certification: a proof that a bound holds, told so that others can verify it.

The search proves its bound on the way to a plan, when it does not yet know how good plans can be.
Told afterwards the proof is shorter: the flights that matter are those within the last gap, and one
set of prices over all flights, without cuts, tells them from the rest.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from windopt.domain.certificate import Proof
from windopt.domain.routing import Route, RoutingInstance
from windopt.solving.exact.cases import CLOSED, MARGIN, Left, as_round, prove
from windopt.solving.exact.clock import Clock, OutOfTime
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.fixing import Fixing
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.pricing import LabelsOverflow
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, arrivals

EFFORT = 2_000_000
"""Half flights of one side of one station to hold at most."""
SHARES = (1.0, 0.5, 0.25, 0.1)
"""Parts of the gap to list the flights of, where those of the whole are too many."""
PATIENCE = 0.6
"""Part of the time left that each part of the gap may take, so that a smaller one has some too."""
SHORT, STOPPED = "Time or memory did not suffice.", "The user stopped it."
LONG = "The flights that matter are too many to be listed."


class Certified(NamedTuple):
    """A proof, and why it is of less than was asked for, where it is."""

    proof: Proof
    reason: str


def certify(
    instance: RoutingInstance,
    routes: tuple[Route, ...],
    bound: float,
    *,
    time_limit: float = 300.0,
    memory: float = 4e9,
) -> Certified:
    """Prove that no plan takes less than ``bound``.

    Parameters
    ----------
    routes
        A plan, the better the fewer flights matter.
    bound
        What to prove [s].
    time_limit
        Wall-clock limit [s].
    memory
        What labels and flights may take [bytes].

    Returns
    -------
    The proof, of a lower bound where time or memory runs out or the user interrupts.
    """
    with Clock(time_limit) as clock:
        search = Search(instance, clock)
        search.offer([(route.station, route.turbines) for route in routes])
        proof, reason = _of_arrivals(search, bound), LONG
        try:
            for other in _proofs(search, bound, memory):
                proof = max(proof, other, key=lambda each: each.bound)
        except KeyboardInterrupt:
            reason = STOPPED
        except (OutOfTime, LabelsOverflow):
            reason = SHORT
    return Certified(proof, reason if proof.bound < bound * (1 - CLOSED) else "")


def _of_arrivals(search: Search, bound: float) -> Proof:
    """Return what the shortest legs to each turbine prove."""
    prices = arrivals(search.networks, search.prize) * search.unit
    tolls = np.zeros(len(search.counts))
    return Proof(min(bound, float(prices.sum())), prices, tolls, ((),) * search.n)


def _proofs(search: Search, bound: float, memory: float) -> Iterator[Proof]:
    """Yield proofs, of ever higher bounds as a rule: over all flights, then over those that matter.

    Raises
    ------
    LabelsOverflow
        If memory does not suffice.
    OutOfTime
        If time is up.
    """
    if search.n == 0:
        return
    relaxation = Relaxation(search, memory, search.counts)
    relaxation.begin()
    yield _over_all_flights(relaxation, bound)
    while relaxation.grow_neighbourhoods():
        yield _over_all_flights(relaxation, bound)
    yield from _over_a_list(_over_all_flights(relaxation, bound), relaxation, bound)


def _over_all_flights(relaxation: Relaxation, bound: float) -> Proof:
    """Return what the relaxation proves; prices are lowered until no reduced cost is negative."""
    search, duals = relaxation.search, relaxation.duals
    lowered = replace(duals, pi=duals.pi + relaxation.least)
    given = as_round(lowered, np.zeros((0, 3), np.int64), relaxation.counts, search.unit)
    neighbours = tuple(tuple(sorted(near)) for near in relaxation.pricer.neighbourhoods.sets)
    value = lowered.value(relaxation.counts) * search.unit
    return Proof(max(0.0, min(bound, value)), given.prices, given.tolls, neighbours)


def _over_a_list(proof: Proof, relaxation: Relaxation, bound: float) -> Iterator[Proof]:
    """Yield what the flights within the gap, or a part of it, prove beyond ``proof``.

    Raises
    ------
    LabelsOverflow
        If memory does not suffice to tell which legs they fly.
    OutOfTime
        If time was too short for a part of the gap.
    """
    search, gap, in_time = relaxation.search, bound - proof.bound, True
    if gap <= CLOSED * bound:
        yield replace(proof, bound=bound)
        return
    fixing = relaxation.fix_arcs(ceiling=(bound + 2 * MARGIN * bound) / search.unit)
    if fixing is None:
        raise LabelsOverflow
    for share in SHARES:
        aim = proof.bound + share * gap
        target, case = aim / search.unit, None
        within = target * (1 + MARGIN) - proof.bound / search.unit
        try:
            with search.within(PATIENCE * search.clock.left):
                pool = _listed(relaxation, fixing, within)
                case = None if pool is None else prove(_all_left(pool, relaxation), target, search)
        except OutOfTime:
            in_time = False
        if case is not None:
            yield replace(proof, bound=aim, case=case)
            break
    if not in_time:
        raise OutOfTime


def _listed(relaxation: Relaxation, fixing: Fixing, gap: float) -> Pool | None:
    """Return the flights of a reduced cost up to ``gap``."""
    networks = fixing.useful(relaxation.pricer.networks, gap)
    search, memory = relaxation.search, relaxation.memory
    pool, _ = enumerate_flights(
        networks, fixing, gap, EFFORT, memory, search.clock, apart=search.limited
    )
    return pool


def _all_left(pool: Pool, relaxation: Relaxation) -> Left:
    search, none = relaxation.search, np.zeros((0, 3), np.int64)
    slices = pool.slices(search.n, search.clock)
    reduced = reduced_costs(pool, slices, relaxation.duals, Rows.subsets(none), search.clock)
    return Left(pool, reduced, none, relaxation.counts)
