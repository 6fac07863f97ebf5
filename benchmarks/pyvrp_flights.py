"""PyVRP on inspection routing: whole numbers, one vehicle for each flight, and no bound.

A flight is a vehicle whose shift lasts t_max at most, and only duration costs.

* [1] Wouda, Lan & Kool (2024), *INFORMS Journal on Computing* 36, 943-955.
"""

from math import inf
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.whole_times import TOO_LONG, UNITS, whole_limits, whole_times
from windopt.domain.routing import Route, RoutingInstance
from windopt.result import Result, Status
from windopt.trace import Progress


def pyvrp_flights(
    instance: RoutingInstance, *, time_limit: float, seed: int, progress: Progress | None = None
) -> Result[tuple[Route, ...]]:
    """Plan flights by PyVRP's iterated local search, for all of the time limit."""
    import pyvrp

    began = perf_counter()
    stop = _Stop(began + time_limit, progress)
    found = pyvrp.solve(_data(instance), stop=stop, seed=seed, collect_stats=False)
    runtime = perf_counter() - began
    if not found.is_feasible():
        return Result(Status.NO_SOLUTION, None, inf, -inf, runtime)
    routes = tuple(sorted(_route(route) for route in found.best.routes()))
    return Result(Status.FEASIBLE, routes, instance.total(routes), -inf, runtime)


class _Stop:
    """Ends PyVRP when time is up, and tells of each better plan."""

    def __init__(self, deadline: float, progress: Progress | None) -> None:
        self._deadline = deadline
        self._progress = progress
        self._best = float(TOO_LONG * UNITS)

    def __call__(self, best_cost: float) -> bool:
        if best_cost < self._best:
            self._best = best_cost
            if self._progress is not None:
                self._progress(best_cost / UNITS, -inf)
        return perf_counter() >= self._deadline


def _route(route: Any) -> Route:
    visits = (stop.idx for stop in route if stop.is_client())
    return Route(int(route.vehicle_type()), tuple(int(i) for i in visits))


def _data(instance: RoutingInstance) -> Any:
    """Return the instance as PyVRP's; one table of times serves all stations with like UAVs."""
    import pyvrp

    n, k = len(instance.turbines), len(instance.stations)
    times = [whole_times(instance, d) for d in range(k)]
    alike = all(np.array_equal(one, times[0]) for one in times)
    makes = [
        pyvrp.VehicleType(
            num_available=n,
            start_depot=d,
            end_depot=d,
            shift_duration=longest,
            unit_distance_cost=0,
            unit_duration_cost=1,
            profile=0 if alike else d,
        )
        for d, longest in enumerate(whole_limits(instance))
    ]
    tables = times[:1] if alike else times
    places = np.vstack([instance.stations, instance.turbines]).tolist()
    return pyvrp.ProblemData(
        locations=[pyvrp.Location(x, y) for x, y in places],
        clients=[pyvrp.Client(k + i) for i in range(n)],
        depots=[pyvrp.Depot(d) for d in range(k)],
        vehicle_types=makes,
        distance_matrices=[np.zeros_like(table) for table in tables],
        duration_matrices=tables,
    )
