"""Rounds of cuts: what they promise at limits, at Ctrl-C and when nothing can be done."""

import signal
import subprocess
import sys
import textwrap
from dataclasses import dataclass
from time import perf_counter

import highspy
import numpy as np
import pytest

from formulations.time_flow import time_flow
from formulations.tour import tour
from windopt.errors import InvalidInput
from windopt.result import Status
from windopt.solving import solve

HARD = """
import numpy as np
from formulations.time_flow import time_flow
rng = np.random.default_rng(2)
xy = rng.uniform(0, 8000, (41, 2))
t = np.hypot(*(xy[:, None] - xy[None]).T) / rng.uniform(10, 16, (41, 41))
hard = time_flow(t, 1.2 * (t[0] + t[:, 0]).max())
"""


@pytest.fixture
def hard():
    """Forty turbines in a wind as no wind blows: minutes of work."""
    names = {}
    exec(HARD, names)
    return names["hard"]


@dataclass(frozen=True)
class Knapsack:
    """The smallest program there is: as few items as weigh enough."""

    model: highspy.Highs
    x: highspy.highs.HighspyArray

    def cuts(self, x):
        return iter(())


def knapsack(weights, least):
    model = highspy.Highs()
    x = model.addBinaries(len(weights))
    model.addConstr((np.array(weights) * x).sum() >= least)
    model.setObjective(x.sum(), highspy.ObjSense.kMinimize)
    return Knapsack(model, x)


def test_a_proof_has_no_gap():
    result = solve(knapsack([3.0, 2.0, 1.0], least=4.0))
    assert result.status is Status.OPTIMAL
    assert result.objective == 2.0
    assert result.gap == 0.0
    assert result.bound_source.startswith("HiGHS")


def test_nothing_that_keeps_every_row_is_infeasible():
    result = solve(knapsack([3.0, 2.0, 1.0], least=7.0))
    assert result.status is Status.INFEASIBLE
    assert result.solution is None


def test_a_time_limit_leaves_a_plan_a_bound_and_a_gap(hard):
    began = perf_counter()
    result = solve(hard, time_limit=4.0)
    assert perf_counter() - began < 5.0
    assert result.status is Status.FEASIBLE
    assert 0.0 < result.bound < result.objective
    assert next(hard.cuts(result.solution), None) is None
    assert sum(len(flight) for _, flight in hard.routes(result.solution)) == 40


def test_no_time_means_no_solution_and_no_wait(hard):
    result = solve(hard, time_limit=0.0)
    assert result.status is Status.NO_SOLUTION
    assert result.bound == -np.inf
    assert result.runtime < 1.0


def test_a_start_is_kept_from_the_first_moment(hard):
    began = []
    result = solve(hard, time_limit=2.0, progress=lambda *news: began.append(news))
    assert began[0][0] == pytest.approx((hard.arcs.t * hard.start).sum())
    assert result.objective <= began[0][0]


def test_a_start_that_breaks_rows_is_dropped():
    program = tour(np.ones((5, 5)) + np.eye(5))
    start = np.zeros((5, 5))
    start[[0, 1, 2, 3, 4], [1, 0, 3, 4, 2]] = 1.0  # two subtours
    result = solve(program, start=start)
    assert result.status is Status.OPTIMAL
    assert len(program.routes(result.solution)[0][1]) == 4


def test_progress_only_ever_improves(hard):
    news = []
    solve(hard, time_limit=3.0, progress=lambda *pair: news.append(pair))
    objective, bound = np.array(news).T
    assert (np.diff(objective[np.isfinite(objective)]) <= 0).all()
    assert (np.diff(bound[np.isfinite(bound)]) >= 0).all()
    assert (bound <= objective).all()


def test_a_gap_that_is_good_enough_ends_the_search():
    t = np.random.default_rng(1).uniform(100, 300, (13, 13))
    result, proof = solve(time_flow(t, 900.0), gap=0.2), solve(time_flow(t, 900.0))
    assert result.status is Status.OPTIMAL
    assert result.gap <= 0.2
    assert result.bound <= proof.objective <= result.objective


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"gap": -0.1}, "gap"),
        ({"time_limit": -1.0}, "time_limit"),
        ({"time_limit": np.nan}, "time_limit"),
        ({"start": np.zeros(2)}, "start"),
    ],
)
def test_options_that_mean_nothing_are_refused(options, field):
    with pytest.raises(InvalidInput, match=field):
        solve(knapsack([3.0, 2.0, 1.0], least=4.0), **options)


def test_the_same_seed_gives_the_same_plan():
    rng = np.random.default_rng(5)
    t = rng.uniform(100, 300, (9, 9))
    first, second = (solve(time_flow(t, 900.0), seed=3) for _ in range(2))
    assert (first.solution == second.solution).all()
    assert first.objective == second.objective
    assert first.bound == second.bound


def test_a_solve_can_be_repeated_after_a_row_is_added():
    program = knapsack([3.0, 2.0, 1.0], least=3.0)
    assert solve(program).objective == 1.0
    program.model.addConstr(program.x[0] == 0)
    assert solve(program).objective == 2.0


@pytest.mark.skipif(sys.platform == "win32", reason="SIGINT to a child is a POSIX affair")
def test_ctrl_c_returns_the_best_plan_and_its_bound_at_once():
    script = HARD + textwrap.dedent("""
        import time
        from windopt.solving import solve
        news = []
        print("ready", flush=True)
        result = solve(hard, time_limit=120.0, progress=lambda *pair: news.append(pair))
        print(result.status, result.solution is not None, result.bound > 0, result.runtime < 60)
    """)
    child = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    with child:
        assert child.stdout.readline() == "ready\n"
        with pytest.raises(subprocess.TimeoutExpired):
            child.wait(5.0)
        began = perf_counter()
        child.send_signal(signal.SIGINT)
        output, errors = child.communicate(timeout=30.0)
    assert perf_counter() - began < 2.0
    assert output == "interrupted True True True\n"
    assert errors == ""
