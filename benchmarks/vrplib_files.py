"""Instances in VRPLIB form, with the best plan known and the bound proved beside each.

Times are hundredths of a second, rounded up, in one full table: first the stations, which are the
depots, then the turbines within reach. A route may last ``DISTANCE`` at most, and its vehicle
returns to where it left from; there may be any number of vehicles at each depot. In a solution,
turbines are numbered from 1, ``Stations`` names the depot of each route, and ``Seconds`` and
``Bound`` are in seconds, not rounded.
"""

from collections.abc import Sequence
from math import inf
from pathlib import Path

import numpy as np

from benchmarks.case import Record
from benchmarks.inspections import Inspection
from benchmarks.report.best_known import best_known, instance
from benchmarks.report.lines import answered
from benchmarks.whole_times import whole_limits, whole_times
from windopt.domain.routing import Route, RoutingInstance
from windopt.errors import InvalidInput, MissingExtra
from windopt.planning.reach import routing_instance


def export(names: Sequence[str], records: Sequence[Record], out: Path) -> list[Path]:
    """Write each instance, and the best plan that the lines have of it.

    Raises
    ------
    MissingExtra
        If vrplib is not installed.
    """
    try:
        import vrplib
    except ModuleNotFoundError:
        raise MissingExtra("The export to VRPLIB", "bench") from None
    out.mkdir(parents=True, exist_ok=True)
    written = []
    for name in names:
        inspection = Inspection.named(name)
        problem, reached = within_reach(inspection)
        path = out / f"{name}.vrp"
        vrplib.write_instance(path, _data(inspection, problem))
        written.append(path)
        best = _best(inspection, records)
        if best is not None:
            routes, about = _solution(problem, reached, best)
            bound = best_known(records)[instance(best)].bound
            vrplib.write_solution(path.with_suffix(".sol"), routes, {**about, "Bound": bound})
    return written


def within_reach(inspection: Inspection) -> tuple[RoutingInstance, list[int]]:
    """Return the instance in numbers with the turbines within reach, and which these are, from 0.

    Raises
    ------
    InvalidInput
        If no turbine is.
    """
    dwell = [float(inspection.dwell)] * len(inspection.farm)
    everything = routing_instance(inspection.farm, inspection.fleet, inspection.wind, dwell=dwell)
    reached = np.flatnonzero(everything.reachable.any(axis=0)).tolist()
    if not reached:
        raise InvalidInput("instance", "with a turbine within reach", inspection.name)
    return everything.subset(reached), reached


def _data(inspection: Inspection, problem: RoutingInstance) -> dict[str, object]:
    k, n = len(problem.stations), len(problem.turbines)
    return {
        "NAME": inspection.name,
        "COMMENT": f"{inspection.farm.name}, hash {inspection.hash}, hundredths of a second",
        "TYPE": "MDVRP",
        "DIMENSION": k + n,
        "CAPACITY": n,
        "DISTANCE": min(whole_limits(problem)),
        "EDGE_WEIGHT_TYPE": "EXPLICIT",
        "EDGE_WEIGHT_FORMAT": "FULL_MATRIX",
        "EDGE_WEIGHT_SECTION": whole_times(problem, 0),
        "NODE_COORD_SECTION": np.vstack([problem.stations, problem.turbines]).round(2),
        "DEMAND_SECTION": [0] * k + [1] * n,
        "DEPOT_SECTION": [*range(1, k + 1), -1],
    }


def _best(inspection: Inspection, records: Sequence[Record]) -> Record | None:
    key = inspection.name, inspection.hash
    mine = [r for r in answered(records) if r.get("flights") and instance(r) == key]
    return min(mine, key=lambda record: record["objective"] or inf, default=None)


def _solution(
    problem: RoutingInstance, reached: Sequence[int], best: Record
) -> tuple[list[list[int]], dict[str, object]]:
    number = {turbine + 1: i for i, turbine in enumerate(reached, 1)}
    routes = [[number[i] for i in visits] for _, visits in best["flights"]]
    stations = [station for station, _ in best["flights"]]
    times = whole_times(problem, 0)
    k = len(problem.stations)
    cost = 0
    for station, route in zip(stations, routes, strict=True):
        stops = [station - 1, *(k + i - 1 for i in route), station - 1]
        cost += int(times[stops[:-1], stops[1:]].sum())
    flown = tuple(
        Route(d - 1, tuple(i - 1 for i in r)) for d, r in zip(stations, routes, strict=True)
    )
    return routes, {
        "Cost": cost,
        "Stations": " ".join(map(str, stations)),
        "Seconds": round(problem.total(flown), 6),
        "Method": best["method"],
    }
