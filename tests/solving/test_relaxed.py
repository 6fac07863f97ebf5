"""The linear relaxation bounds the program, and leaves it as it was."""

import numpy as np
import pytest

import windopt
from formulations.time_flow import time_flow
from windopt.errors import InvalidInput
from windopt.result import Status

RNG = np.random.default_rng(0)
XY = RNG.uniform(0, 3000, (9, 2))
T = np.linalg.norm(XY[:, None] - XY, axis=-1) / 16.0


def test_the_relaxation_bounds_the_program_before_and_after():
    program = time_flow(T, 700.0)
    relaxed = windopt.relax(program)
    solved = windopt.solve(program)
    assert relaxed.status is solved.status is Status.OPTIMAL
    assert relaxed.bound == relaxed.objective <= solved.effort.cut_bound <= solved.objective + 1e-6
    assert relaxed.solution.shape == program.x.shape
    assert windopt.relax(program).objective >= relaxed.objective - 1e-6  # with the rows added


def test_rows_without_a_solution_have_no_relaxation():
    program = time_flow(T, 700.0)
    program.model.addConstr(program.x[:, 0, 1:].sum() <= 0)
    assert windopt.relax(program).status is Status.INFEASIBLE


def test_only_an_integer_program_has_a_relaxation():
    with pytest.raises(InvalidInput, match="integer program"):
        windopt.relax(object())
    with pytest.raises(InvalidInput, match="time_limit"):
        windopt.relax(time_flow(T, 700.0), time_limit=-1)
