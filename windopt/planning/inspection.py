"""Inspection flights for a farm: domain objects in, a checked plan out."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from time import perf_counter

import numpy as np

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.plan import Flight, InspectionPlan, SpeedRule
from windopt.domain.routing import Route, RoutingInstance
from windopt.domain.turbine import require_not_negative
from windopt.domain.wind import Wind
from windopt.errors import FailedCheck, InvalidInput
from windopt.planning.reach import (
    dwell_per_turbine,
    restricted,
    routing_instance,
    unreachable_turbines,
)
from windopt.planning.routing_methods import METHODS, RoutingMethod
from windopt.result import Result, Status
from windopt.trace import Progress, Recorder

DEFAULT_METHOD = "algorithm-2"


def plan_inspection(
    farm: Farm,
    fleet: Fleet,
    wind: Wind,
    *,
    method: str | RoutingMethod = DEFAULT_METHOD,
    dwell: float | Sequence[float] = 0.0,
    rule: SpeedRule | str = SpeedRule.EXACT,
    gap: float = 0.0,
    time_limit: float = 60.0,
    seed: int = 0,
    progress: Progress | None = None,
) -> Result[InspectionPlan]:
    """Plan flights that visit every turbine within reach once, in the least total time.

    Parameters
    ----------
    farm, fleet, wind
        What to inspect, from where, and the steady wind to fly in.
    method
        One of :data:`windopt.planning.routing_methods.METHODS`, or a function of its own with
        their signature.
    dwell
        Time spent at each turbine [s]: one for all, or one each in the farm's order.
    rule
        How the wind bends the speed over ground: ``"exact"`` or ``"paper"``.
    gap
        Relative gap at which an exact method may stop [-].
    time_limit
        Wall-clock limit [s].
    seed
        Of whatever the method draws at random.
    progress
        Called with objective and bound whenever one of them improves.

    Returns
    -------
    Result
        Turbines out of reach are listed in the plan with the reason and the rest is planned;
        the objective is the total time of all flights [s].

    Raises
    ------
    InvalidInput
        If the method or the rule is unknown, or a dwell is negative.
    FailedCheck
        If the independent checker finds a fault in the plan.
    """
    start, recorder = perf_counter(), Recorder(progress)
    require_not_negative("time_limit", time_limit)
    require_not_negative("gap", gap)
    solve = _chosen(method)
    rule = _rule(rule)
    dwells = dwell_per_turbine(farm, dwell)
    everything = routing_instance(farm, fleet, wind, dwell=dwells, rule=rule)
    unreachable = unreachable_turbines(farm, fleet, wind, everything)
    reached = np.flatnonzero(everything.reachable.any(axis=0)).tolist()
    if reached:
        instance = restricted(everything, reached)
        left = max(0.0, time_limit - (perf_counter() - start))
        found = solve(instance, gap=gap, time_limit=left, seed=seed, progress=recorder)
    else:
        found = Result(Status.OPTIMAL, (), 0.0, 0.0, 0.0, reason="No turbine is within reach.")
    result: Result[InspectionPlan] = found.carrying(None)
    if found.solution is not None:
        flights = _flights(found.solution, reached, everything, farm, fleet, dwells)
        plan = InspectionPlan(farm, fleet, wind, dwells, flights, unreachable, rule)
        result = found.carrying(plan)
        _assert_sound(result)
    trace = recorder.until(result.objective, result.bound)
    return replace(result, runtime=perf_counter() - start, trace=trace)


def _chosen(method: str | RoutingMethod) -> RoutingMethod:
    if not isinstance(method, str):
        return method
    if method not in METHODS:
        raise InvalidInput("method", f"to be one of {', '.join(METHODS)}", repr(method))
    return METHODS[method]


def _rule(rule: SpeedRule | str) -> SpeedRule:
    try:
        return SpeedRule(rule)
    except ValueError:
        raise InvalidInput("rule", f"to be one of {', '.join(SpeedRule)}", repr(rule)) from None


def _flights(
    routes: tuple[Route, ...],
    reached: Sequence[int],
    everything: RoutingInstance,
    farm: Farm,
    fleet: Fleet,
    dwells: Sequence[float],
) -> tuple[Flight, ...]:
    """Return routes among the reached turbines as flights of the fleet, station by station."""
    flights = []
    for station, among_reached in sorted(routes):
        turbines = tuple(reached[i] for i in among_reached)
        nodes = (0, *(i + 1 for i in turbines), 0)
        pause = (*(dwells[i] for i in turbines), 0.0)
        times = [everything.t[station, i, j] for i, j in pairwise(nodes)]
        flights.append(
            Flight(
                station=fleet.stations[station].name,
                uav=fleet.stations[station].uav.name,
                turbines=tuple(farm.names[i] for i in turbines),
                legs=tuple(float(t - p) for t, p in zip(times, pause, strict=True)),
                duration=everything.duration(Route(station, turbines)),
            )
        )
    return tuple(flights)


def _assert_sound(result: Result[InspectionPlan]) -> None:
    report = check(result)
    if not report.passed:
        raise FailedCheck(report.violations)
