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
from windopt.domain.wind import Wind
from windopt.errors import FailedCheck, require_kind, require_one_of
from windopt.planning.assignment import Assignment, assigned_to, stations_of_turbines
from windopt.planning.reach import (
    dwell_per_turbine,
    routing_instance,
    unreachable_turbines,
)
from windopt.planning.routing_methods import OwnMethod, chosen_method, make_ready
from windopt.planning.search_options import MEMORY, SearchOptions
from windopt.planning.start import Start, inspection_of, routes_of
from windopt.planning.worth import turbines_left_out, weighed, worth_per_turbine
from windopt.result import Result, Status
from windopt.trace import Progress, Recorder

DEFAULT_METHOD = "exact"


def plan_inspection(
    farm: Farm,
    fleet: Fleet,
    wind: Wind,
    *,
    method: str | OwnMethod = DEFAULT_METHOD,
    dwell: float | Sequence[float] = 0.0,
    rule: SpeedRule | str = SpeedRule.EXACT,
    worth: float | Sequence[float] | None = None,
    assignment: Assignment | None = None,
    start: Start | None = None,
    gap: float = 0.0,
    time_limit: float = 60.0,
    memory: float = MEMORY,
    seed: int = 0,
    progress: Progress | None = None,
) -> Result[InspectionPlan]:
    """Plan flights that visit every turbine within reach once, in the least total time.

    Where a station has a limited number of flights, or turbines have a worth, some may be left
    out; only the method ``exact`` weighs that.

    Parameters
    ----------
    farm, fleet, wind
        What to inspect, from where, and the steady wind to fly in.
    method
        One of :data:`windopt.planning.routing_methods.METHODS`, or a function of its own, as
        :class:`windopt.planning.routing_methods.OwnMethod` is.
    dwell
        Time spent at each turbine [s]: one for all, or one each in the farm's order.
    rule
        How the wind bends the speed over ground: ``"exact"`` or ``"paper"``.
    worth
        What inspecting a turbine is worth [s of flight]: one for all, or one each in the farm's
        order. Unless given, every turbine must be inspected; or, where flights are limited, as
        many as possible first, then the least time. For priorities see
        :func:`windopt.planning.worth.worth_of_priorities`.
    assignment
        Which stations may inspect which turbine: ``"nearest"``, or a station or several by
        turbine. Any station may inspect any turbine unless given.
    start
        A plan to begin with, perhaps for another wind; what can no longer be flown of it is
        repaired or dropped; the logger ``windopt.start`` tells what is left. Not for heuristics.
    gap
        Relative gap at which an exact method may stop [-], below 1.
    time_limit
        Wall-clock limit [s]; it begins once the method ``exact`` is compiled, as it is before its
        first use on a machine.
    memory
        What the lists of the method ``exact`` may take [bytes].
    seed
        Of whatever the method draws at random.
    progress
        Called with objective and bound whenever one of them improves.

    Returns
    -------
    Result
        Turbines out of reach, and those left out, are listed in the plan with the reason and the
        rest is planned; the objective is the total time of all flights and the worth of what is
        left out [s].

    Raises
    ------
    InvalidInput
        If the farm, the fleet or the wind is not one, the method or the rule is unknown, a number
        is negative, a name is not known, or the method cannot do what is asked for.
    FailedCheck
        If the independent checker finds a fault in the plan.
    """
    require_kind("farm", farm, Farm)
    require_kind("fleet", fleet, Fleet)
    require_kind("wind", wind, Wind)
    options = SearchOptions(gap, time_limit, seed, memory)
    require_one_of("rule", rule, SpeedRule)
    rule = SpeedRule(rule)
    dwells = dwell_per_turbine(farm, dwell)
    worths = worth_per_turbine(farm, fleet, worth)
    solve = chosen_method(method, weighs=worths is not None, improves=start is not None)
    everything = routing_instance(farm, fleet, wind, dwell=dwells, rule=rule)
    assigned = stations_of_turbines(farm, fleet, assignment, everything)
    everything = weighed(assigned_to(everything, fleet, assigned), fleet, worths)
    unreachable = unreachable_turbines(farm, fleet, wind, everything)
    reached = np.flatnonzero(everything.reachable.any(axis=0)).tolist()
    if reached:
        make_ready(method)
    began, recorder = perf_counter(), Recorder(progress)
    options = replace(options, progress=recorder)
    if reached:
        instance = everything.subset(reached)
        if start is not None:
            routes = routes_of(inspection_of(start), instance, fleet, farm.names, reached)
            options = replace(options, start=routes)
        left = max(0.0, time_limit - (perf_counter() - began))
        found = solve(instance, replace(options, time_limit=left))
    else:
        found = Result(Status.OPTIMAL, (), 0.0, 0.0, 0.0, reason="No turbine is within reach.")
    result: Result[InspectionPlan] = found.carrying(None)
    if found.solution is not None:
        flights = _flights(found.solution, reached, everything, farm, fleet, dwells)
        names = [farm.names[i] for i in reached]
        left_out = turbines_left_out(found.solution, instance, names) if reached else ()
        plan = InspectionPlan(
            farm, fleet, wind, dwells, flights, unreachable, rule, worths, left_out, assigned
        )
        result = found.carrying(plan)
        _assert_sound(result)
    trace = recorder.until(result.objective, result.bound)
    return replace(result, runtime=perf_counter() - began, trace=trace)


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
