"""Methods side by side on the same instances, every answer added up anew.

That takes the instance's times for granted, which all methods are given alike; whether they are
right for a farm and a wind is what :mod:`windopt.checking` asks of a plan.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from inspect import signature
from math import inf, isclose
from time import perf_counter
from typing import Any

from windopt.domain.routing import Route, RoutingInstance
from windopt.result import Result, Status
from windopt.solving import solve

Routes = tuple[Route, ...]
Formulation = Callable[..., Any]
Method = Callable[..., Result[Routes]]


@dataclass(frozen=True)
class Row:
    """What one method made of one instance.

    Parameters
    ----------
    method, instance
        Their names.
    result
        Its routes, with status, objective [s], bound [s] and runtime [s].
    faults
        What is wrong with the routes, a sentence each, or the exception in place of routes.
    """

    method: str
    instance: str
    result: Result[Routes]
    faults: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """A table of methods by instances; ``str`` prints it."""

    rows: tuple[Row, ...]

    def __str__(self) -> str:
        head = f"{'instance':16} {'method':16} {'status':16} {'objective':>12} {'bound':>12}"
        lines = [f"{head} {'gap':>8} {'runtime':>9} faults"]
        for row in self.rows:
            found = row.result
            lines.append(
                f"{row.instance:16} {row.method:16} {found.status:16} {found.objective:12.2f} "
                f"{found.bound:12.2f} {found.gap:8.2%} {found.runtime:8.2f}s {len(row.faults)}"
            )
        return "\n".join(lines)


def compare(
    methods: Mapping[str, Formulation | Method],
    instances: Mapping[str, RoutingInstance] | Sequence[RoutingInstance],
    *,
    time_limit: float = 60.0,
    gap: float = 0.0,
    seed: int = 0,
) -> Comparison:
    """Run every method on every instance under one time limit, programs built within it.

    A method that raises an exception has it as its fault and reason, and the others go on.

    Parameters
    ----------
    methods
        By name: either a formulation ``f(t, t_max, allowed=...)`` that returns a program with
        ``routes(x)``, or a method ``f(instance, time_limit=..., seed=...)``, whose first parameter
        is called so; a method with a parameter ``gap`` is given that too.
    instances
        By name, or in order.
    time_limit, gap, seed
        Of each run: wall-clock limit [s], relative gap to stop at [-], seed.
    """
    named = (
        instances
        if isinstance(instances, Mapping)
        else {str(number): instance for number, instance in enumerate(instances)}
    )
    options = {"time_limit": time_limit, "gap": gap, "seed": seed}
    return Comparison(
        tuple(
            _row(name, method, title, instance, options)
            for title, instance in named.items()
            for name, method in methods.items()
        )
    )


def _row(
    name: str,
    method: Formulation | Method,
    title: str,
    instance: RoutingInstance,
    options: Mapping[str, Any],
) -> Row:
    began = perf_counter()
    try:
        result = _run(method, instance, options).timed(perf_counter() - began)
        return Row(name, title, result, tuple(faults(instance, result)))
    except Exception as error:  # whatever it is, the rows of the other methods stand
        fault = f"{type(error).__name__}: {error}"
        runtime = perf_counter() - began
        nothing = Result[Routes](Status.NO_SOLUTION, None, inf, -inf, runtime, reason=fault)
        return Row(name, title, nothing, (fault,))


def _run(
    method: Formulation | Method, instance: RoutingInstance, options: Mapping[str, Any]
) -> Result[Routes]:
    parameters = signature(method).parameters
    if next(iter(parameters), None) == "instance":
        taken = {k: value for k, value in options.items() if k != "gap" or k in parameters}
        found: Result[Routes] = method(instance, **taken)
        return found
    deadline = perf_counter() + options["time_limit"]
    program: Any = method(instance.t, instance.t_max, allowed=instance.allowed)
    left = max(0.0, deadline - perf_counter())
    result = solve(program, **{**options, "time_limit": left})
    if result.solution is None:
        return result
    routes = tuple(Route(d, tuple(turbines)) for d, turbines in program.routes(result.solution))
    return result.carrying(routes)


def faults(instance: RoutingInstance, result: Result[Routes]) -> list[str]:
    """List what is wrong with visits, durations, objective and bound, by the instance's times."""
    if result.solution is None:
        return []
    found = []
    visited = sorted(i for route in result.solution for i in route.turbines)
    if visited != list(range(len(instance.turbines))):
        found.append("not every turbine is visited once")
    for route in result.solution:
        if instance.duration(route) > instance.t_max[route.station] * (1 + 1e-9):
            found.append(f"the flight {route} is longer than t_max")
        if not instance.allowed[route.station, list(route.turbines)].all():
            found.append(f"the flight {route} visits a turbine its station may not serve")
    if not isclose(result.objective, instance.total(result.solution), rel_tol=1e-6):
        found.append("the objective is not the total time of the flights")
    if result.bound > result.objective * (1 + 1e-6):
        found.append("the bound is above the objective")
    return found
