"""Ipopt's endings as results: proved, local, stopped, impossible."""

import os
import signal
import threading
import time
from dataclasses import dataclass

import casadi as ca
import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.result import Status
from windopt.solving import nonlinear, solve


@dataclass(frozen=True)
class Program:
    opti: ca.Opti
    x: ca.MX


def program(n=1):
    opti = ca.Opti()
    return Program(opti, opti.variable(n))


def two_valleys():
    """Build a quartic whose left valley is the deeper one."""
    p = program()
    p.opti.minimize((p.x**2 - 1) ** 2 + 0.1 * p.x)
    return p


def long_valley():
    """Build a Rosenbrock valley that Ipopt walks for many seconds."""
    p = program(20_000)
    here, there = p.x[:-1], p.x[1:]
    p.opti.minimize(100 * ca.sumsqr(there - here**2) + ca.sumsqr(1 - here))
    p.opti.subject_to(p.x >= -3)
    p.opti.set_initial(p.x, -1)
    return p


def test_a_parabola_ends_in_its_vertex():
    p = program(2)
    p.opti.minimize(ca.sumsqr(p.x - ca.DM([1, 2])) + 3)
    result = solve(p)
    assert result.status is Status.LOCALLY_OPTIMAL
    assert result.solution == pytest.approx([1, 2])
    assert result.objective == pytest.approx(3)
    assert result.bound == -np.inf
    assert result.reason == ""


def test_the_best_of_several_starts_counts():
    right, left = np.array([1.0]), np.array([-1.0])
    assert solve(two_valleys(), starts=[right]).found() > 0
    for starts in ([right, left], [left, right]):
        assert solve(two_valleys(), starts=starts).found() < 0


def test_the_initial_guess_counts_where_no_start_is_given():
    p = two_valleys()
    p.opti.set_initial(p.x, 0.9)
    assert solve(p).found() > 0


def test_a_bound_is_kept_to_the_last_digit():
    p = program()
    p.opti.minimize(-p.x)
    p.opti.subject_to(p.opti.bounded(0, p.x, 1))
    x = solve(p).found()
    assert 1 - 1e-8 < x[0] <= 1.0


def test_bounds_that_contradict_each_other_are_infeasible():
    p = program()
    p.opti.minimize(p.x**2)
    p.opti.subject_to(p.x >= 1)
    p.opti.subject_to(p.x <= 0)
    result = solve(p)
    assert result.status is Status.INFEASIBLE
    assert "contradict" in result.reason
    with pytest.raises(ValueError, match="Proved"):
        result.found()


def test_no_feasible_point_nearby_proves_nothing():
    p = program(2)
    p.opti.minimize(ca.sumsqr(p.x))
    p.opti.subject_to(ca.sumsqr(p.x) >= 1)
    p.opti.subject_to(ca.sumsqr(p.x) <= 0.5)
    p.opti.set_initial(p.x, [0.3, 0.4])
    result = solve(p)
    assert result.status is Status.NO_SOLUTION
    assert "no feasible point" in result.reason


def test_no_time_is_no_solution():
    result = solve(two_valleys(), time_limit=0.0)
    assert result.status is Status.NO_SOLUTION
    assert "time limit" in result.reason


@pytest.mark.parametrize("limit", [-1.0, np.nan])
def test_a_time_limit_that_means_nothing_is_refused(limit):
    with pytest.raises(InvalidInput, match="time_limit"):
        solve(two_valleys(), time_limit=limit)


def test_a_deadline_that_has_passed_leaves_no_time():
    assert nonlinear.solve(two_valleys(), time_limit=-1.0).status is Status.NO_SOLUTION


def test_a_time_limit_is_kept_and_leaves_a_feasible_point():
    begin = time.perf_counter()
    result = solve(long_valley(), time_limit=0.5)
    assert time.perf_counter() - begin < 1.5  # the promise: within a second
    assert result.status is Status.FEASIBLE
    assert "time limit" in result.reason


def test_a_limit_of_iterations_is_no_proof():
    p = program(2)
    p.opti.minimize((1 - p.x[0]) ** 2 + 100 * (p.x[1] - p.x[0] ** 2) ** 2)
    p.opti.subject_to(p.x[0] * p.x[1] >= 4)
    result = solve(p, max_iter=1)
    assert result.status is Status.NO_SOLUTION
    assert "iterations" in result.reason


def test_ctrl_c_ends_the_search_and_is_no_exception():
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    result = solve(long_valley(), time_limit=60)
    timer.join()
    assert result.status is Status.INTERRUPTED
    assert result.runtime < 10


def test_a_mistake_in_a_program_is_an_exception():
    p = program()
    p.opti.minimize((p.x - p.opti.parameter()) ** 2)
    with pytest.raises(RuntimeError, match="parameter"):
        solve(p)


def test_a_solver_is_built_once_for_the_same_limits(monkeypatch):
    p = two_valleys()
    solve(p)
    built = []
    monkeypatch.setattr(ca.Opti, "solver", lambda *_: built.append(1))
    solve(p)
    assert not built


def test_solutions_do_not_depend_on_what_was_solved_before():
    p = two_valleys()
    first = nonlinear.solve(p, starts=[np.array([0.7])])
    nonlinear.solve(p, starts=[np.array([-2.0])])
    again = nonlinear.solve(p, starts=[np.array([0.7])])
    assert np.array_equal(first.found(), again.found())
