"""The routing methods by name, exact and heuristic, with one signature.

The formulations begin with Algorithm 2's plan, so that a limit never leaves them with nothing.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any, Protocol

from formulations.route_indexed import RouteIndexed, route_indexed
from formulations.time_flow import TimeFlow, time_flow
from windopt.domain.routing import Route, RoutingInstance
from windopt.errors import InvalidInput, require_one_of
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.heuristics.baseline import baseline
from windopt.heuristics.relaxation import NAME, least_total_time
from windopt.heuristics.splitting import split_by_rule
from windopt.planning.search_options import SearchOptions
from windopt.result import Result, Status
from windopt.solving import integer
from windopt.trace import Progress

Routes = tuple[Route, ...]

HEAD_START = 0.2
"""Share of the time limit that Algorithm 2 may use before a formulation begins."""

TOO_LARGE = "To build the program would take too much of the time; this is the plan to begin with."

ROUNDING = 1e-9
"""Seconds by which two sums of the same legs may differ."""

LARGEST = 2_000_000
"""Arcs of the largest program that is built, whatever the time limit: some 2 GB."""

TIME_FLOW_PACE, ROUTE_INDEXED_PACE = 100_000, 20_000
"""Arcs that are built for each second of the time limit; half of what is usual."""


RoutingMethod = Callable[[RoutingInstance, SearchOptions], Result[Routes]]
"""A way to plan flights that visit every turbine of an instance once."""


class OwnMethod(Protocol):
    """A routing method of one's own, which need know nothing of windopt but the instance."""

    def __call__(
        self,
        instance: RoutingInstance,
        *,
        gap: float,
        time_limit: float,
        seed: int,
        progress: Progress | None,
    ) -> Result[Routes]:
        """Return routes that visit every turbine of ``instance`` once."""


def by_keywords(method: OwnMethod) -> RoutingMethod:
    """Return a method of one's own as a routing method."""

    def solve(instance: RoutingInstance, options: SearchOptions) -> Result[Routes]:
        return method(
            instance,
            gap=options.gap,
            time_limit=options.time_limit,
            seed=options.seed,
            progress=options.progress,
        )

    return solve


def _heuristic(method: Callable[..., Result[Routes]]) -> RoutingMethod:
    """Return a heuristic as a routing method; neither gap nor start mean anything to it."""

    def solve(instance: RoutingInstance, options: SearchOptions) -> Result[Routes]:
        result = method(instance, time_limit=options.time_limit, seed=options.seed)
        if options.progress is not None:
            options.progress(result.objective, result.bound)
        return result

    return solve


def _formulation(build: Callable[[RoutingInstance, Result[Routes], float], Any]) -> RoutingMethod:
    """Return a formulation as a routing method.

    Parameters
    ----------
    build
        Builds the program of an instance, given the plan it begins with and a time limit, or
        returns ``None`` where that would take too much of the time.
    """

    def solve(instance: RoutingInstance, options: SearchOptions) -> Result[Routes]:
        began = perf_counter()
        head_start = HEAD_START * options.time_limit
        first = algorithm_2(instance, time_limit=head_start, seed=options.seed)
        first = _or_start(first, instance, options.start)
        if first.status is Status.INTERRUPTED:
            return first
        program = build(instance, first, options.time_limit)
        if program is None:
            return replace(first, reason=f"{TOO_LARGE} {first.reason}".strip())
        found = integer.solve(
            program,
            gap=options.gap,
            time_limit=max(0.0, began + options.time_limit - perf_counter()),
            seed=options.seed,
            start=program.point(first.found()),
            progress=options.progress,
        )
        return _better(found.carrying(_routes(program, found)), first)

    return solve


def _or_start(
    first: Result[Routes], instance: RoutingInstance, start: Routes | None
) -> Result[Routes]:
    """Return the given start in place of the first plan where it is the better one."""
    if start is None or instance.total(start) >= first.objective:
        return first
    objective = instance.total(start)
    return replace(first, solution=start, objective=objective, reason="")


def _routes(program: Any, found: Result[Any]) -> Routes | None:
    if found.solution is None:
        return None
    return tuple(Route(station, turbines) for station, turbines in program.routes(found.solution))


def _better(found: Result[Routes], first: Result[Routes]) -> Result[Routes]:
    """Return the better plan of both, with the better bound."""
    if found.solution is None or found.objective > first.objective:
        status = Status.FEASIBLE if found.status is Status.NO_SOLUTION else found.status
        found = replace(found, status=status, solution=first.solution, objective=first.objective)
    if first.bound > found.bound:
        found = replace(found, bound=first.bound, bound_source=first.bound_source)
    return found


def time_flow_program(
    instance: RoutingInstance, first: Result[Routes], time_limit: float
) -> TimeFlow | None:
    """Build the program of :mod:`formulations.time_flow`."""
    if instance.t.size > min(LARGEST, TIME_FLOW_PACE * time_limit):
        return None
    return time_flow(instance.t, instance.t_max, allowed=instance.allowed)


def route_indexed_program(
    instance: RoutingInstance, first: Result[Routes], time_limit: float
) -> RouteIndexed | None:
    """Build the program of :mod:`formulations.route_indexed`, with as many routes as can pay.

    Where it never takes longer to fly on than by way of the station, two flights of a station
    that together fit into t_max are merged at no cost. Any two of those left last longer than
    t_max together, so a station flies fewer than twice the total time over t_max.
    """
    t, n = instance.t, len(instance.turbines)
    merge_at_no_cost = (t[:, 1:, 1:] <= t[:, 1:, :1] + t[:, :1, 1:] + ROUNDING).all()
    routes = min(n, int(2 * first.objective / instance.t_max.min()) + 1) if merge_at_no_cost else n
    flown = [route.station for route in first.found()]
    routes = max(routes, *(flown.count(d) for d in range(len(t))))
    if routes * t.size > min(LARGEST, ROUTE_INDEXED_PACE * time_limit):
        return None
    return route_indexed(t, instance.t_max, routes=routes, allowed=instance.allowed)


def _exact(instance: RoutingInstance, options: SearchOptions) -> Result[Routes]:
    """Solve by column generation."""
    from windopt.solving.column_generation import column_generation  # numba loads slowly

    found = column_generation(
        instance,
        time_limit=options.time_limit,
        gap=options.gap,
        seed=options.seed,
        start=options.start,
        memory=options.memory,
        progress=options.progress,
    )
    if found.status in (Status.FEASIBLE, Status.INTERRUPTED):
        found = _bounded(found, instance)
    return replace(found, asked_gap=options.gap)


def _bounded(found: Result[Routes], instance: RoutingInstance) -> Result[Routes]:
    """Return a result with the bound of the heuristics where a search has not come as far."""
    if instance.prize is not None:
        return found
    bound = least_total_time(instance)
    return found if bound <= found.bound else replace(found, bound=bound, bound_source=NAME)


METHODS: dict[str, RoutingMethod] = {
    "exact": _exact,
    "time-flow": _formulation(time_flow_program),
    "route-indexed": _formulation(route_indexed_program),
    "algorithm-2": _heuristic(algorithm_2),
    "algorithm-2-as-published": _heuristic(partial(algorithm_2, split=split_by_rule)),
    "baseline": _heuristic(baseline),
}
"""Routing methods by name."""

IMPROVES = ("exact", "time-flow", "route-indexed")
"""Methods that begin with a plan where one is given."""


def chosen_method(
    method: str | OwnMethod, *, weighs: bool = False, improves: bool = False
) -> RoutingMethod:
    """Return the method of a name, or a function as a method.

    Parameters
    ----------
    weighs
        Whether it has to leave out turbines that are not worth their time.
    improves
        Whether it has to begin with a plan.

    Raises
    ------
    InvalidInput
        If the name is unknown, or the method cannot do what it has to.
    """
    if isinstance(method, str):
        require_one_of("method", method, METHODS)
    name = method if isinstance(method, str) else "a function"
    if weighs and name != "exact":
        raise InvalidInput("method", "exact where flights are few or turbines have a worth", name)
    if improves and name not in IMPROVES:
        raise InvalidInput("method", f"to be one of {', '.join(IMPROVES)} with a start", name)
    return METHODS[method] if isinstance(method, str) else by_keywords(method)


def make_ready(method: str | OwnMethod) -> None:
    """Compile what a method needs where that was not done yet, before its time begins."""
    if method == "exact":
        from windopt.solving.readiness import make_ready as compile_exact  # numba loads slowly

        compile_exact()
