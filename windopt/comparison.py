"""Methods side by side on the same instances, every answer through a check."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from inspect import signature
from math import isclose
from typing import Any

from windopt.domain.routing import Route, RoutingInstance
from windopt.result import Result
from windopt.solving import solve

Formulation = Callable[..., Any]
Method = Callable[..., Result[tuple[Route, ...]]]


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
        What is wrong with the routes, a sentence each.
    """

    method: str
    instance: str
    result: Result[tuple[Route, ...]]
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
    """Run every method on every instance under one time limit.

    Parameters
    ----------
    methods
        By name: either a formulation ``f(t, t_max, allowed=...)`` that returns a program with
        ``routes(x)``, or a method whose first parameter is called ``instance``.
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
    rows = []
    for title, instance in named.items():
        for name, method in methods.items():
            result = _run(method, instance, time_limit=time_limit, gap=gap, seed=seed)
            rows.append(Row(name, title, result, tuple(faults(instance, result))))
    return Comparison(tuple(rows))


def _run(
    method: Formulation | Method, instance: RoutingInstance, **options: Any
) -> Result[tuple[Route, ...]]:
    if next(iter(signature(method).parameters)) == "instance":
        del options["gap"]
        found: Result[tuple[Route, ...]] = method(instance, **options)
        return found
    program: Any = method(instance.t, instance.t_max, allowed=instance.allowed)
    result = solve(program, **options)
    if result.solution is None:
        return result
    routes = tuple(Route(d, tuple(turbines)) for d, turbines in program.routes(result.solution))
    return result.carrying(routes)


def faults(instance: RoutingInstance, result: Result[tuple[Route, ...]]) -> list[str]:
    """List what is wrong with a result: visits, durations, its objective and its bound."""
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
