"""The problems that can be benchmarked. One entry adds a problem."""

from importlib import import_module

from benchmarks.case import Problem
from windopt.errors import MissingExtra

PROBLEMS = {
    "routing": "benchmarks.routing",
    "yaw": "benchmarks.yaw",
    "forecast": "benchmarks.forecast_cases",
    "edge": "benchmarks.edge_cases",
    "paper": "benchmarks.paper",
}
"""Module of each problem, whose ``PROBLEM`` describes it."""

SETS = "small", "medium", "full", "growth", "guard"


def problem(name: str) -> Problem:
    """Return a problem by name, imported when it is asked for.

    Raises
    ------
    MissingExtra
        If a package that it measures is not installed.
    """
    try:
        found: Problem = import_module(PROBLEMS[name]).PROBLEM
    except ModuleNotFoundError as lacking:
        if (lacking.name or "").split(".")[0] in ("benchmarks", "formulations", "windopt"):
            raise
        raise MissingExtra(f"The benchmark {name!r} ({lacking.name})", "bench") from lacking
    return found
