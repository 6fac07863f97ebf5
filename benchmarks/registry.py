"""The problems that can be benchmarked. One entry adds a problem."""

from importlib import import_module

from benchmarks.case import Problem

PROBLEMS = {
    "routing": "benchmarks.routing",
    "yaw": "benchmarks.yaw",
}
"""Module of each problem, whose ``PROBLEM`` describes it."""

TABLES = {"forecast": "benchmarks.forecast", "edge": "benchmarks.edge"}
"""Module of each benchmark that prints a table of its own, by options of its own."""

SETS = "small", "medium", "full", "growth"


def problem(name: str) -> Problem:
    """Return a problem by name, imported when it is asked for."""
    found: Problem = import_module(PROBLEMS[name]).PROBLEM
    return found
