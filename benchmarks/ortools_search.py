"""OR-tools' search for flights: a problem in JSON on the standard input, flights on the output.

This runs as a process of its own and imports nothing that imports HiGHS.
"""

import json
import sys
from collections.abc import Iterator
from math import inf
from time import perf_counter
from typing import Any

Flights = list[tuple[int, list[int]]]


def search(problem: dict[str, Any]) -> Flights:
    """Return the best flights found: each one's station and turbines."""
    from ortools.constraint_solver import pywrapcp

    began = perf_counter()
    home = [d for d, count in enumerate(problem["vehicles"]) for _ in range(count)]
    nodes, k = len(problem["times"][0]), len(problem["vehicles"])
    manager = pywrapcp.RoutingIndexManager(nodes, len(home), home, home)
    model = pywrapcp.RoutingModel(manager)
    transits = [model.RegisterTransitMatrix(table) for table in problem["times"]]
    for vehicle, d in enumerate(home):
        model.SetArcCostEvaluatorOfVehicle(transits[d], vehicle)
    by_vehicle, limits = [transits[d] for d in home], [problem["t_max"][d] for d in home]
    model.AddDimensionWithVehicleTransitAndCapacity(by_vehicle, 0, limits, True, "time")
    _tell_of_better(model)
    found = model.SolveWithParameters(_options(problem["deadline"] - (perf_counter() - began)))
    if found is None:
        return []
    flights = ((d, list(_visits(manager, model, found, v))) for v, d in enumerate(home))
    return [(d, [node - k for node in visits]) for d, visits in flights if visits]


def _options(seconds: float) -> Any:
    """Return the options: cheapest insertion, then guided local search."""
    from ortools.constraint_solver import pywrapcp, routing_enums_pb2

    first = routing_enums_pb2.FirstSolutionStrategy
    local = routing_enums_pb2.LocalSearchMetaheuristic
    options = pywrapcp.DefaultRoutingSearchParameters()
    options.first_solution_strategy = first.PARALLEL_CHEAPEST_INSERTION
    options.local_search_metaheuristic = local.GUIDED_LOCAL_SEARCH
    options.time_limit.FromMilliseconds(max(1, int(1000 * seconds)))
    return options


def _tell_of_better(model: Any) -> None:
    """Print the cost of each plan that is the best so far."""
    best = inf

    def tell() -> None:
        nonlocal best
        cost = model.CostVar().Max()
        if cost < best:
            best = cost
            print(cost, flush=True)

    model.AddAtSolutionCallback(tell)


def _visits(manager: Any, model: Any, found: Any, vehicle: int) -> Iterator[int]:
    index = found.Value(model.NextVar(model.Start(vehicle)))
    while not model.IsEnd(index):
        yield manager.IndexToNode(index)
        index = found.Value(model.NextVar(index))


if __name__ == "__main__":
    print(json.dumps(search(json.load(sys.stdin))))
