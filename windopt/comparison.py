"""Methods side by side on the same instances, every answer added up anew.

That takes the instance's times for granted, which all methods are given alike; whether they are
right for a farm and a wind is what :mod:`windopt.checking` asks of a plan.
"""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from inspect import signature
from math import inf, isclose
from time import perf_counter
from typing import TYPE_CHECKING, Any

from windopt.domain.routing import Route, RoutingInstance
from windopt.errors import MissingExtra
from windopt.result import Result, Status
from windopt.solving import relax, solve
from windopt.trace import Progress, Recorder

if TYPE_CHECKING:
    from pandas import DataFrame

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
        Its routes, with status, objective [s], bound [s], runtime [s] and what it took.
    faults
        What is wrong with the routes, a sentence each, or the exception in place of routes.
    seed
        What random choices began with.
    """

    method: str
    instance: str
    result: Result[Routes]
    faults: tuple[str, ...]
    seed: int = 0

    @property
    def cells(self) -> dict[str, Any]:
        """The row of the table by column; times in seconds."""
        found, effort = self.result, self.result.effort
        return {
            "instance": self.instance,
            "method": self.method,
            "seed": self.seed,
            "status": str(found.status),
            "objective": found.objective,
            "bound": found.bound,
            "gap": found.gap,
            "LP bound": effort.lp_bound,
            "after cuts": effort.cut_bound,
            "rounds": effort.rounds,
            "rows added": effort.rows,
            "nodes": effort.nodes,
            "runtime": found.runtime,
            "faults": len(self.faults),
        }


FORMATS = {
    "instance": (16, ""),
    "method": (16, ""),
    "seed": (4, ""),
    "status": (11, ""),
    "objective": (10, ".2f"),
    "bound": (10, ".2f"),
    "gap": (8, ".2%"),
    "LP bound": (10, ".2f"),
    "after cuts": (10, ".2f"),
    "rounds": (6, ""),
    "rows added": (10, ""),
    "nodes": (6, ""),
    "runtime": (7, ".2f"),
    "faults": (6, ""),
}
"""Width and format of each column as :class:`Comparison` prints it."""


@dataclass(frozen=True)
class Comparison:
    """A table of methods by instances; ``str`` prints it, :meth:`frame` hands it to pandas."""

    rows: tuple[Row, ...]

    def __str__(self) -> str:
        head = "  ".join(f"{name:>{width}}" for name, (width, _) in FORMATS.items())
        return "\n".join([head, *(_line(row.cells) for row in self.rows)])

    def frame(self) -> "DataFrame":
        """Return the table as a pandas ``DataFrame``, a row for each answer.

        Raises
        ------
        MissingExtra
            If pandas is not installed.
        """
        try:
            from pandas import DataFrame
        except ModuleNotFoundError:
            raise MissingExtra("A table in pandas", "bench") from None
        return DataFrame([row.cells for row in self.rows], columns=list(FORMATS))


def _line(cells: Mapping[str, Any]) -> str:
    return "  ".join(f"{cells[name]:>{width}{form}}" for name, (width, form) in FORMATS.items())


def compare(
    methods: Mapping[str, Formulation | Method],
    instances: Mapping[str, RoutingInstance] | Sequence[RoutingInstance],
    *,
    time_limit: float = 60.0,
    gap: float = 0.0,
    seeds: Sequence[int] = (0,),
) -> Comparison:
    """Run every method on every instance under one time limit, programs built within it.

    A method that raises an exception has it as its fault and reason, and the others go on. The
    linear relaxation of a formulation is solved apart, after its run and at no cost to it.

    Parameters
    ----------
    methods
        By name: either a formulation ``f(t, t_max, allowed=...)`` that returns a program with
        ``routes(x)``, or a method ``f(instance, time_limit=..., seed=...)``, whose first parameter
        is called so; a method with a parameter ``gap`` or ``progress`` is given that too.
    instances
        By name, or in order.
    time_limit, gap
        Of each run: wall-clock limit [s], relative gap to stop at [-].
    seeds
        Each method runs on each instance once with each.
    """
    named = (
        instances
        if isinstance(instances, Mapping)
        else {str(number): instance for number, instance in enumerate(instances)}
    )
    limits = {"time_limit": time_limit, "gap": gap}
    return Comparison(
        tuple(
            _row(name, method, title, instance, {**limits, "seed": seed})
            for title, instance in named.items()
            for name, method in methods.items()
            for seed in seeds
        )
    )


def _row(
    name: str,
    method: Formulation | Method,
    title: str,
    instance: RoutingInstance,
    options: Mapping[str, Any],
) -> Row:
    recorder = Recorder()
    began = perf_counter()
    try:
        result = as_method(method)(instance, **options, progress=recorder)
        trace = recorder.until(result.objective, result.bound)
        result = replace(result, runtime=perf_counter() - began, trace=trace)
        if not _takes_an_instance(method):
            result = replace(
                result, effort=replace(result.effort, lp_bound=_lp_bound(method, instance))
            )
        return Row(name, title, result, tuple(faults(instance, result)), options["seed"])
    except Exception as error:  # whatever it is, the rows of the other methods stand
        fault = f"{type(error).__name__}: {error}"
        runtime = perf_counter() - began
        nothing = Result[Routes](Status.NO_SOLUTION, None, inf, -inf, runtime, reason=fault)
        return Row(name, title, nothing, (fault,), options["seed"])


def as_method(method: Formulation | Method) -> Method:
    """Return a formulation or a method as one that takes every option.

    Parameters
    ----------
    method
        As :func:`compare` takes it; a method is not given the options it has no parameter for.

    Returns
    -------
    A method ``f(instance, gap=..., time_limit=..., seed=..., progress=...)``, as
    :func:`windopt.plan_inspection` takes it.
    """
    if not _takes_an_instance(method):
        return _method_of(method)
    optional = {"gap", "progress"} - set(signature(method).parameters)

    @wraps(method)
    def run(instance: RoutingInstance, **options: Any) -> Result[Routes]:
        taken = {name: value for name, value in options.items() if name not in optional}
        found: Result[Routes] = method(instance, **taken)
        return found

    return run


def _takes_an_instance(method: Formulation | Method) -> bool:
    return next(iter(signature(method).parameters), None) == "instance"


def _lp_bound(formulation: Formulation, instance: RoutingInstance) -> float:
    """Return the value of the linear relaxation as it is stated, which no row has tightened."""
    program = formulation(instance.t, instance.t_max, allowed=instance.allowed)
    return relax(program).bound


def _method_of(formulation: Formulation) -> Method:
    @wraps(formulation)
    def run(
        instance: RoutingInstance,
        *,
        gap: float = 0.0,
        time_limit: float = 60.0,
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Result[Routes]:
        instance.require_all("a formulation")
        deadline = perf_counter() + time_limit
        program = formulation(instance.t, instance.t_max, allowed=instance.allowed)
        left = max(0.0, deadline - perf_counter())
        found = solve(program, time_limit=left, gap=gap, seed=seed, progress=progress)
        if found.solution is None:
            return found
        flights = program.routes(found.solution)
        return found.carrying(tuple(Route(d, tuple(turbines)) for d, turbines in flights))

    return run


def faults(instance: RoutingInstance, result: Result[Routes]) -> list[str]:
    """List what is wrong with visits, durations, objective and bound, by the instance's times."""
    if result.solution is None:
        return []
    found = []
    visits = Counter(i for route in result.solution for i in route.turbines)
    missing = len(visits) < len(instance.turbines) and instance.prize is None
    if missing or visits.total() > len(visits):
        found.append("not every turbine is visited once")
    sent = Counter(route.station for route in result.solution)
    if instance.max_flights is not None and any(sent[d] > instance.max_flights[d] for d in sent):
        found.append("a station flies more often than it can")
    for route in result.solution:
        if instance.duration(route) > instance.t_max[route.station] * (1 + 1e-9):
            found.append(f"the flight {route} is longer than t_max")
        if not instance.allowed[route.station, list(route.turbines)].all():
            found.append(f"the flight {route} visits a turbine its station may not serve")
    if not isclose(result.objective, instance.cost(result.solution), rel_tol=1e-6):
        found.append("the objective is not the total time of the flights")
    if result.bound > result.objective * (1 + 1e-6):
        found.append("the bound is above the objective")
    return found
