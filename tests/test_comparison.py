"""Methods side by side: one clock for all, and every fault in its own row."""

from dataclasses import replace
from time import sleep

import numpy as np
import pytest

from formulations.time_flow import time_flow
from windopt.comparison import compare
from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.result import Result, Status

PLACES = np.array([(0.0, 0.0), (700.0, 0.0), (0.0, 900.0), (800.0, 800.0)])
INSTANCE = RoutingInstance(
    t=np.linalg.norm(PLACES[:, None] - PLACES, axis=-1)[None] / 16.0,
    t_max=np.array([1080.0]),
    stations=PLACES[:1],
    turbines=PLACES[1:],
    w=np.zeros(2),
    allowed=np.ones((1, 3), dtype=bool),
)


def breaks(instance, *, time_limit, seed):
    raise RuntimeError("out of luck")


def test_formulations_and_methods_agree_on_a_small_instance():
    table = compare({"program": time_flow, "heuristic": algorithm_2}, {"square": INSTANCE})
    program, heuristic = table.rows
    assert program.result.status is Status.OPTIMAL
    assert heuristic.result.objective == pytest.approx(program.result.objective)
    assert program.faults == heuristic.faults == ()
    assert "square" in str(table)


def test_a_method_that_raises_leaves_the_other_rows():
    table = compare({"broken": breaks, "heuristic": algorithm_2}, [INSTANCE])
    broken, heuristic = table.rows
    assert broken.result.status is Status.NO_SOLUTION
    assert broken.faults == ("RuntimeError: out of luck",) == (broken.result.reason,)
    assert heuristic.faults == ()
    assert "no_solution" in str(table)


def test_building_a_program_counts_as_its_time():
    def slow(t, t_max, *, allowed):
        sleep(0.3)
        return time_flow(t, t_max, allowed=allowed)

    (row,) = compare({"slow": slow}, [INSTANCE], time_limit=0.2).rows
    assert row.result.runtime > 0.3
    assert row.result.status is not Status.OPTIMAL


def test_a_method_gets_a_gap_if_it_takes_one():
    seen = []

    def method(instance, *, gap, time_limit, seed):
        seen.append((gap, time_limit, seed))
        return algorithm_2(instance, time_limit=time_limit, seed=seed)

    compare({"mine": method}, [INSTANCE], gap=0.05, time_limit=7.0, seeds=[3, 4])
    assert seen == [(0.05, 7.0, 3), (0.05, 7.0, 4)]


def test_an_answer_tells_how_it_came_about():
    (row,) = compare({"program": time_flow}, [INSTANCE]).rows
    times, objectives, bounds = zip(*row.result.trace, strict=True)
    assert list(times) == sorted(times)
    assert (objectives[-1], bounds[-1]) == (row.result.objective, row.result.bound)


def test_the_table_goes_to_pandas():
    pytest.importorskip("pandas")
    frame = compare({"program": time_flow, "broken": breaks}, {"square": INSTANCE}).frame()
    assert list(frame.method) == ["program", "broken"]
    assert list(frame.status) == ["optimal", "no_solution"]
    assert {"LP bound", "after cuts", "rounds", "rows added", "nodes"} <= set(frame.columns)


@pytest.mark.parametrize(
    ("routes", "change", "fault"),
    [
        ((Route(0, (0, 1)),), {}, "not every turbine is visited once"),
        ((Route(0, (0, 1, 2)),), {"t_max": np.array([150.0])}, "longer than t_max"),
        ((Route(0, (0, 1, 2)),), {"allowed": np.array([[True, True, False]])}, "may not serve"),
        ((Route(0, (0, 1, 9)),), {}, "IndexError"),
    ],
)
def test_what_is_wrong_with_an_answer_is_told(routes, change, fault):
    instance = replace(INSTANCE, **change)

    def wrong(instance, *, time_limit, seed):
        return Result(Status.OPTIMAL, routes, 200.0, 200.0, 0.0)

    (row,) = compare({"wrong": wrong}, [instance]).rows
    assert any(fault in told for told in row.faults)
    assert "the objective is not the total time of the flights" in row.faults or "Index" in fault


def test_a_bound_above_the_objective_is_a_fault():
    total = INSTANCE.total((Route(0, (0, 1, 2)),))

    def boastful(instance, *, time_limit, seed):
        return Result(Status.OPTIMAL, (Route(0, (0, 1, 2)),), total, 2 * total, 0.0)

    (row,) = compare({"boastful": boastful}, [INSTANCE]).rows
    assert row.faults == ("the bound is above the objective",)
