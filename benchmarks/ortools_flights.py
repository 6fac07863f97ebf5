"""OR-tools on inspection routing, in a process of its own: it cannot share one with HiGHS.

A flight is a vehicle. Each station has half as many again as Algorithm 2 sends from there, since
OR-tools slows down with every vehicle that stays behind. Guided local search runs for all of the
time limit; nothing in it is random.
"""

import json
import subprocess
import sys
from math import ceil, inf
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.whole_times import UNITS, whole_limits, whole_times
from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.result import Result, Status
from windopt.trace import Progress

HEAD_START = 0.1
"""Share of the time limit in which Algorithm 2 says how many vehicles are needed."""

SPARE, SPARES = 1.5, 2
"""Vehicles to each that Algorithm 2 sends, and beyond."""


def ortools_flights(
    instance: RoutingInstance, *, time_limit: float, seed: int, progress: Progress | None = None
) -> Result[tuple[Route, ...]]:
    """Plan flights by OR-tools, whatever the seed."""
    began = perf_counter()
    first = algorithm_2(instance, time_limit=HEAD_START * time_limit, seed=seed).found()
    sent = np.bincount([route.station for route in first], minlength=len(instance.stations))
    problem = {
        "times": [whole_times(instance, d).tolist() for d in range(len(sent))],
        "t_max": whole_limits(instance),
        "vehicles": [ceil(SPARE * count) + SPARES for count in sent.tolist()],
        "deadline": began + time_limit - perf_counter(),
    }
    routes = tuple(Route(d, tuple(turbines)) for d, turbines in _ask(problem, progress))
    runtime = perf_counter() - began
    if not routes:
        return Result(Status.NO_SOLUTION, None, inf, -inf, runtime)
    best = tuple(sorted(routes))
    return Result(Status.FEASIBLE, best, instance.total(best), -inf, runtime)


def _ask(problem: dict[str, Any], progress: Progress | None) -> list[Any]:
    """Have the other process solve the problem, and return its flights."""
    flights: list[Any] = []
    command = [sys.executable, "-m", "benchmarks.ortools_search"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(json.dumps(problem))
        process.stdin.close()
        for line in process.stdout:
            told = json.loads(line)
            if isinstance(told, list):
                flights = told
            elif progress is not None:
                progress(told / UNITS, -inf)
    if process.returncode:
        raise RuntimeError(f"OR-tools ended with {process.returncode}")
    return flights
