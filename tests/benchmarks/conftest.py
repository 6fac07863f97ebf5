"""Methods that go wrong, as a researcher's file beside her run, and lines of routing cases."""

import pytest

METHODS = """
import os
from time import sleep

from formulations.time_flow import time_flow


def few_flights(t, t_max, *, allowed=None):
    program = time_flow(t, t_max, allowed=allowed)
    program.model.addConstr(program.x[:, 0, 1:].sum() <= 4)
    return program


def crashes(instance, *, time_limit, seed):
    os.write(2, b"out of luck")
    os._exit(3)


def hangs(instance, *, time_limit, seed):
    sleep(600)


def raises(instance, *, time_limit, seed):
    raise RuntimeError("out of luck")
"""


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """Go to a folder with a module ``mine`` of methods."""
    (tmp_path / "mine.py").write_text(METHODS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    return tmp_path


FARM_A, FARM_B = "a-w10-090-d000", "b-w10-090-d000"
FACTS = {
    "turbines": 20,
    "stations": 2,
    "wind_speed": 10,
    "wind_direction": 90,
    "unreachable": 0,
    "rounds": 0,
}


def line(method, objective, bound, runtime, *, instance=FARM_A, status="feasible", limit=10.0):
    """Return the line of a case; what it says of the instance is said by its name."""
    about = {"hash": instance, "farm": instance[0], "dwell": int(instance[-3:]), **FACTS}
    answer = {
        "objective": objective,
        "bound": bound,
        "runtime": runtime,
        "cpu": runtime,
        "trace": [[runtime / 2, objective, bound]],
    }
    reason = {"reason": "out of luck"}
    return {
        "problem": "routing",
        "instance": instance,
        "method": method,
        "time_limit": limit,
        "seed": 0,
        "status": status,
        **(reason if status == "failed" else about | answer | {"reason": ""}),
        "commit": "abc",
        "machine": {"processor": "one", "processors": 1, "memory_gb": 1},
        "versions": {"python": "3"},
        "command": "python -m benchmarks run routing",
    }


@pytest.fixture(name="line")
def _line():
    return line


@pytest.fixture
def rows():
    """Return the rows of a table as mappings from its head."""

    def mapped(table):
        head, *found = table
        return [dict(zip(head, row, strict=True)) for row in found]

    return mapped


@pytest.fixture
def lines():
    """Two farms by an exact method and a heuristic, and one case that failed."""
    return [
        line("exact", 100.0, 100.0, 2.0, status="optimal"),
        line("pyvrp", 103.0, None, 10.0),
        line("exact", 250.0, 200.0, 10.0, instance=FARM_B),
        line("pyvrp", 240.0, None, 10.0, instance=FARM_B),
        line("broken", None, None, 1.0, status="failed"),
    ]
