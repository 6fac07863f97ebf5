"""Inspection routing: real farms in many winds, by exact methods, heuristics and rivals."""

from collections.abc import Iterator, Sequence
from importlib import import_module
from itertools import product
from math import isfinite

from benchmarks.case import Case, Problem, Record
from benchmarks.inspections import Inspection
from benchmarks.processor import processor_time
from windopt.comparison import as_method
from windopt.domain.plan import InspectionPlan
from windopt.errors import InvalidInput
from windopt.io.optiwindnet import optiwindnet_sizes
from windopt.planning.inspection import plan_inspection
from windopt.planning.routing_methods import METHODS, OwnMethod
from windopt.result import Moment, Result

FURTHER_METHODS = {
    "pyvrp": "benchmarks.pyvrp_flights:pyvrp_flights",
    "or-tools": "benchmarks.ortools_flights:ortools_flights",
    "time-flow-lp": "benchmarks.relaxations:time_flow_lp",
    "route-indexed-lp": "benchmarks.relaxations:route_indexed_lp",
}
"""Methods of other projects and bounds without plans, by where they are called."""

DEFAULT_METHODS = {
    "small": (*METHODS, *FURTHER_METHODS),
    "medium": ("exact", "pyvrp", "algorithm-2"),
    "full": ("exact",),
    "growth": ("exact", "time-flow", "pyvrp", "algorithm-2"),
    "guard": ("exact", "algorithm-2"),
}
SETS = tuple(DEFAULT_METHODS)
TIME_LIMITS = {"small": 5.0, "medium": 60.0, "full": 300.0, "growth": 60.0, "guard": 60.0}

DIRECTIONS = range(0, 360, 45)
WINDS: dict[str, tuple[tuple[int, int], ...]] = {
    "small": ((0, 0), (10, 90), (14, 225)),
    "medium": ((10, 90), (5, 225)),
    "full": ((0, 0), *product((5, 10, 14), DIRECTIONS)),
    "growth": ((10, 90),),
    "guard": ((10, 90), (14, 225)),
}
"""Speed [m/s] and direction [deg] of each wind; the paper's is 10 m/s from the east."""
DWELLS = {"small": (0,), "medium": (0, 60), "full": (0, 60, 240), "growth": (0,), "guard": (0, 60)}
"""Seconds at each turbine."""
LARGEST_SMALL = 51
"""Turbines of the largest farm in the small set."""
GUARDS = "albatros", "kfA", "mermaid"
"""Farms that are planned anew whenever the code changes; each is proved within seconds."""
GRIDS = (*range(20, 201, 20), 210, 300)
COMPILING = 200.0
"""Time in which the exact method's loops are compiled on any machine [s]."""
COMPILED_BY = "grid20-w10-090-d000", "kfA-w10-090-d000"
"""One station, and several, whose flights are joined of halves."""
TOLD = 1e-3
"""Change of objective or bound that a line's trace tells [-]."""


def instances(chosen: str) -> Sequence[str]:
    """Return the names of a set's instances, small farms first."""
    return [inspection.name for inspection in _instances(chosen)]


def _instances(chosen: str) -> Iterator[Inspection]:
    sizes = optiwindnet_sizes()
    farms = sorted(sizes, key=lambda handle: (sizes[handle], handle))
    if chosen == "small":
        farms = [handle for handle in farms if sizes[handle] <= LARGEST_SMALL]
    if chosen == "guard":
        farms = list(GUARDS)
    if chosen == "growth":
        farms = [f"grid{n}" for n in GRIDS]
    for handle, (speed, direction), dwell in product(farms, WINDS[chosen], DWELLS[chosen]):
        yield Inspection(handle, speed, direction, dwell)


def method(name: str) -> str | OwnMethod:
    """Return the name of a method of windopt, a rival, or what ``module:function`` calls.

    Raises
    ------
    InvalidInput
        If there is no such method.
    """
    if name in METHODS:
        return name
    module, _, function = FURTHER_METHODS.get(name, name).partition(":")
    try:
        return as_method(getattr(import_module(module), function))
    except (ImportError, AttributeError, ValueError) as missing:
        known = ", ".join((*METHODS, *FURTHER_METHODS))
        raise InvalidInput("method", f"to be one of {known}, or module:function", missing) from None


def measure(case: Case) -> Record:
    """Plan an instance's flights and have them checked."""
    instance, planned_by = Inspection.named(case.instance), method(case.method)
    facts, began = instance.facts, processor_time()
    result = plan_inspection(
        instance.farm,
        instance.fleet,
        instance.wind,
        method=planned_by,
        dwell=float(instance.dwell),
        time_limit=case.time_limit,
        seed=case.seed,
    )
    return facts | outcome(result) | {"cpu": round(processor_time() - began, 3)}


def outcome(result: Result[InspectionPlan]) -> Record:
    """Return what a line says of an answer; times in seconds."""
    effort = result.effort
    return {
        "status": str(result.status),
        "objective": round(result.objective, 6),
        "bound": round(result.bound, 6),
        "gap": round(result.gap, 9),
        "runtime": round(result.runtime, 3),
        "bound_source": result.bound_source,
        "reason": result.reason,
        "lp_bound": round(effort.lp_bound, 6),
        "cut_bound": round(effort.cut_bound, 6),
        "rounds": effort.rounds,
        "rows": effort.rows,
        "nodes": effort.nodes,
        "trace": _thinned(result.trace),
        **_flights(result.solution),
    }


def _thinned(trace: Sequence[Moment]) -> list[tuple[float, float, float]]:
    """Return the moments that tell something, and the last."""
    kept: list[Moment] = []
    for moment in trace:
        if not kept or any(
            abs(new - old) > TOLD * abs(new)
            for new, old in zip(moment[1:], kept[-1][1:], strict=True)
            if isfinite(new)
        ):
            kept.append(moment)
    kept += [moment for moment in trace[-1:] if moment not in kept]
    return [(round(m.time, 3), round(m.objective, 2), round(m.bound, 2)) for m in kept]


def _flights(plan: InspectionPlan | None) -> Record:
    """Return the flights by numbers, stations and turbines each from 1, and who is left out."""
    if plan is None:
        return {"unreachable": 0, "flights": []}
    station = {name: i for i, name in enumerate(plan.fleet.names, 1)}
    turbine = {name: i for i, name in enumerate(plan.farm.names, 1)}
    flights = [
        [station[flight.station], [turbine[name] for name in flight.turbines]]
        for flight in plan.flights
    ]
    return {"unreachable": len(plan.unreachable), "flights": flights}


def warm_up(name: str) -> None:
    """Plan a small farm by a method, or two by the exact one, which compiles all of its loops."""
    limit = COMPILING if name == "exact" else 1.0
    for farm in COMPILED_BY if name == "exact" else COMPILED_BY[:1]:
        measure(Case("routing", farm, name, limit))


PROBLEM = Problem(
    instances=instances,
    methods=DEFAULT_METHODS.__getitem__,
    time_limits=TIME_LIMITS,
    measure=measure,
    warm_up=warm_up,
)
