"""Inspection plans with a proof, by column generation.

The recipe is that of exact vehicle routing [1], [2], for flights limited in time: a relaxation
over flights that may return to a turbine, tightened until the flights that can matter are few
enough to be listed, and a choice among these. Its ideas stand in :mod:`windopt.solving.exact`,
one to a module.

* [1] Baldacci, Christofides & Mingozzi (2008), *Mathematical Programming* 115, 351-385.
* [2] Pessoa, Sadykov, Uchoa & Vanderbeck (2020), *Mathematical Programming* 183, 483-523.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import count
from math import inf

from windopt.domain.routing import Route, RoutingInstance
from windopt.domain.turbine import require_not_negative
from windopt.result import Effort, Result, Status
from windopt.solving.exact.clock import Clock, OutOfTime
from windopt.solving.exact.closing import Closing
from windopt.solving.exact.fewer_flights import fewer_flights
from windopt.solving.exact.first_plan import find_plan
from windopt.solving.exact.local_search import improve
from windopt.solving.exact.pricing import LabelsOverflow
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.replanning import Replanning
from windopt.solving.exact.search import Flight, Search
from windopt.solving.limits import require_gap, require_memory

EFFORT, MORE = 300_000, 2.0
"""Half flights that the first attempt to list all flights may hold, and the growth of that."""
NARROWER = 0.75
"""What cuts must make of a gap whose flights were too many, before they are listed again."""
MUCH_NARROWER = 0.85
"""What cuts must make of a gap that was closed in parts, before the next is."""
ROUNDS = 2
"""Rounds of cuts between two lists, at most."""
THOROUGH = 3
"""Times the first local search to search again each time flights are too many; every second time
it begins anew."""
LEAST_TIME = 1e-3
"""What cuts are said to take at least [s]."""
SOURCE = "column generation"


def column_generation(
    instance: RoutingInstance,
    *,
    time_limit: float = 300.0,
    gap: float = 0.0,
    seed: int = 0,
    start: tuple[Route, ...] | None = None,
    memory: float = 4e9,
    progress: Callable[[float, float], None] | None = None,
) -> Result[tuple[Route, ...]]:
    """Find the plan of least total time, or time and prizes left behind, and prove that it is.

    Parameters
    ----------
    time_limit
        Wall-clock limit [s].
    gap
        Relative gap at which to stop [-], below 1.
    start
        A plan to improve on; one that does not keep the limits is passed over.
    memory
        What labels and flights may take [bytes]; HiGHS and the programs it solves are not counted.
    progress
        Called with objective and bound [s] whenever one of them improves.

    Returns
    -------
    The best plan and the best bound found when the gap is closed, time is up, or the user
    interrupts; INFEASIBLE with the turbines that no flight can reach.
    """
    require_not_negative("time_limit", time_limit)
    require_gap("gap", gap)
    require_memory("memory", memory)
    with Clock(time_limit) as clock:
        search = Search(instance, clock, gap, progress)
        if search.unreachable.size:
            return _infeasible(search)
        stopped, lacking = Status.FEASIBLE, ""
        try:
            flights = [(route.station, route.turbines) for route in start or ()]
            lacking = _plan(search, flights, memory, seed)
        except KeyboardInterrupt:
            stopped = Status.INTERRUPTED
        return _result(search, stopped, lacking)


def _infeasible(search: Search) -> Result[tuple[Route, ...]]:
    """Return that no plan exists, and because of which turbines."""
    beyond = ", ".join(str(i) for i in search.unreachable)
    reason = f"No flight from any station reaches turbines {beyond} and is back in time."
    return Result(Status.INFEASIBLE, None, inf, inf, search.clock.elapsed, SOURCE, reason)


def _plan(search: Search, start: Sequence[Flight], memory: float, seed: int) -> str:
    """Find a plan and prove it; return what ran out before that."""
    try:
        find_plan(search, seed, start)
        search.note("start")
        _prove(search, memory, seed)
    except OutOfTime:
        return "time"
    except LabelsOverflow:
        return "memory"
    return ""


def _prove(search: Search, memory: float, seed: int) -> None:
    """Raise the bound to the plan, or find a better plan."""
    relaxation = Relaxation(search, memory, search.counts)
    relaxation.begin()
    search.lp_bound = search.bound
    while relaxation.grow_neighbourhoods() or relaxation.round_flights():
        pass
    rounded = relaxation.master.rounded()
    improve(search, seed + 1, start=rounded)
    closing, effort = Closing(relaxation, seed + 2), float(EFFORT)
    # Labels are held while a few flights are planned anew, lists are not.
    replanning = Replanning(search, lambda few, start: _plan(few, start, memory / 2, seed), seed)
    closing.between = replanning.improve
    narrowing, listed = True, relaxation.gap
    for attempt in count(1):
        in_parts = attempt > 1 and (not narrowing or relaxation.gap <= MUCH_NARROWER * listed)
        listed = relaxation.gap if in_parts else listed
        if closing.close(int(effort), in_parts=in_parts):
            return
        improve(search, seed + 2 + attempt, THOROUGH, None if attempt % 2 == 0 else rounded)
        if attempt > 1:  # most farms are proved by the second list
            replanning.improve()
        narrowing = _narrow(closing, int(effort))
        if attempt > 1:
            relaxation.relent()
        rounded = relaxation.master.rounded()
        effort = min(MORE * effort, memory)  # a half flight takes more than a byte


def _narrow(closing: Closing, effort: int) -> bool:
    """Cut until much less of the gap is left, or often enough, and tell whether that helps.

    Returns
    -------
    Whether cuts help; ``closing`` keeps how fast they raised the bound.
    """
    relaxation, clock = closing.relaxation, closing.search.clock
    before, began = relaxation.gap, clock.elapsed
    enough = NARROWER * before
    closing.by_cuts = 0.0
    _enter(relaxation)
    for _ in range(ROUNDS):
        if relaxation.gap <= enough:
            break
        if not relaxation.cut(effort):
            return False
        _enter(relaxation)
        if not closing.fix(effort):
            return False
    closing.by_cuts = (before - relaxation.gap) / max(clock.elapsed - began, LEAST_TIME)
    return True


def _enter(relaxation: Relaxation) -> None:
    """Send whole numbers of flights, in all and into turbines that need several."""
    while relaxation.round_flights() or relaxation.enter_crowded_sets():
        pass


def _result(search: Search, stopped: Status, lacking: str) -> Result[tuple[Route, ...]]:
    """Return what is known, and what ran out before it was proved."""
    if search.found:
        search.take_as_good(fewer_flights(search.flights, search.networks))
    runtime = search.clock.elapsed
    bound = search.bound * search.unit
    if not search.found:
        nothing = Status.NO_SOLUTION if stopped is Status.FEASIBLE else stopped
        return Result(nothing, None, inf, bound, runtime, SOURCE)
    status = Status.OPTIMAL if search.closed else stopped
    objective = search.objective * search.unit
    reason = ""
    if status is Status.FEASIBLE:
        reason = f"Not proved optimal: {lacking} ran out." if lacking else "Not proved optimal."
    effort = Effort(lp_bound=search.lp_bound * search.unit, nodes=search.nodes)
    found = Result(status, search.routes(), objective, bound, runtime, SOURCE, reason)
    return replace(found, effort=effort)
