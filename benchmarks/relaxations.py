"""Linear relaxations of the formulations as methods: they bound every plan and find none."""

from collections.abc import Callable
from dataclasses import replace
from math import inf
from time import perf_counter
from typing import Any

from windopt.comparison import Method
from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.planning.routing_methods import route_indexed_program, time_flow_program
from windopt.result import Effort, Result, Status
from windopt.solving import relax

Bound = Result[tuple[Route, ...]]
Build = Callable[[RoutingInstance, Bound, float], Any]

HEAD_START = 0.1
"""Share of the time limit that Algorithm 2 has to say how large the programs must be."""


def _relaxation(build: Build) -> Method:
    """Return the relaxation of a program as a method."""

    def bound(instance: RoutingInstance, *, time_limit: float, seed: int) -> Bound:
        began = perf_counter()
        first = algorithm_2(instance, time_limit=HEAD_START * time_limit, seed=seed)
        program = build(instance, first, time_limit)
        if program is None:
            return Result(Status.NO_SOLUTION, None, inf, -inf, 0.0, reason="Too large to be built.")
        found = relax(program, time_limit=max(0.0, began + time_limit - perf_counter()))
        status = Status.NO_SOLUTION if found.status is Status.OPTIMAL else found.status
        effort = Effort(lp_bound=found.bound)
        nothing: Bound = found.carrying(None)
        return replace(nothing, status=status, objective=inf, effort=effort)

    return bound


time_flow_lp = _relaxation(time_flow_program)
route_indexed_lp = _relaxation(route_indexed_program)
