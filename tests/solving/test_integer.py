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
from highspy import HighsModelStatus

from formulations.time_flow import time_flow
from formulations.tour import tour
from windopt.errors import InvalidInput
from windopt.result import Status
from windopt.solving import rounds, solve

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
    assert result.bound_source == "HiGHS, linear relaxation"


def test_what_only_whole_numbers_make_infeasible_is_proved_by_branch_and_cut():
    program = knapsack([2.0, 2.0, 2.0], least=3.0)
    program.model.addConstr((2.0 * program.x).sum() <= 3.0)
    result = solve(program)
    assert result.status is Status.INFEASIBLE
    assert result.bound_source == "HiGHS, branch and cut"


@dataclass
class Mistaken:
    """Answers for HiGHS: calls what it stands for something else, until presolve is off."""

    model: highspy.Highs
    says: highspy.HighsModelStatus

    def __getattr__(self, name):
        return getattr(self.model, name)

    def getModelStatus(self):  # noqa: N802
        _, presolve = self.model.getOptionValue("presolve")
        return self.model.getModelStatus() if presolve == "off" else self.says


def test_a_solution_outweighs_a_claim_that_there_is_none(monkeypatch):
    program = knapsack([3.0, 2.0, 1.0], least=4.0)
    monkeypatch.setattr(rounds, "RELAXATION_SHARE", 0.0)
    mistaken = Mistaken(program.model, HighsModelStatus.kInfeasible)
    result = solve(Knapsack(mistaken, program.x))
    assert result.status is Status.FEASIBLE
    assert result.objective == result.solution.sum() == 2.0
    assert result.bound == -np.inf
    assert result.bound_source == ""
    assert "disproves" in result.reason


def test_what_presolve_cannot_tell_apart_is_solved_without_it():
    program = knapsack([3.0, 2.0, 1.0], least=7.0)
    mistaken = Mistaken(program.model, HighsModelStatus.kUnboundedOrInfeasible)
    assert solve(Knapsack(mistaken, program.x)).status is Status.INFEASIBLE
    assert program.model.getOptionValue("presolve")[1] == "choose"


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


def test_what_progress_raises_reaches_the_caller_and_spoils_nothing():
    t = np.random.default_rng(1).uniform(100, 300, (9, 9))
    program = time_flow(t, 900.0)

    def fail(*news):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        solve(program, progress=fail)
    again = solve(program)
    assert again.status is Status.OPTIMAL
    assert again.objective == pytest.approx(solve(time_flow(t, 900.0)).objective)


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
        ({"gap": 1.0}, "gap"),
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
    assert perf_counter() - began < 10.0  # of 120; a busy machine takes its time
    assert output == "interrupted True True True\n"
    assert errors == ""
