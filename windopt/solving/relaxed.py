"""The linear relaxation of a program: what it proves before any row is added or branch is taken."""

from math import inf
from time import perf_counter

import highspy
import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.result import Result, Status
from windopt.solving.rounds import IntegerProgram
from windopt.solving.watched import run

HIGHS = highspy.HighsModelStatus
STATUS = {HIGHS.kOptimal: Status.OPTIMAL, HIGHS.kInfeasible: Status.INFEASIBLE}


def relax(program: IntegerProgram, *, time_limit: float = 60.0) -> Result[NDArray[np.float64]]:
    """Solve the linear relaxation of an integer program with the rows that it has now.

    The program itself stays as it is, rows that were added to it included.

    Parameters
    ----------
    time_limit
        Wall-clock limit [s].

    Returns
    -------
    Result
        The solution is the array of the program's ``x``, fractional, and objective and bound are
        its value, which bounds the program itself.

    Raises
    ------
    InvalidInput
        If ``time_limit`` is negative.
    """
    if not time_limit >= 0.0:
        raise InvalidInput("time_limit", ">= 0", time_limit)
    began, model = perf_counter(), program.model
    model.silent()
    model.setOptionValue("solve_relaxation", True)
    model.setOptionValue("time_limit", model.getRunTime() + time_limit)
    try:
        stopped = run(model, lambda news: None)
        ending = model.getModelStatus()
        values = np.asarray(model.getSolution().col_value)
        value = model.getInfo().objective_function_value
    finally:
        model.setOptionValue("solve_relaxation", False)
        model.setOptionValue("time_limit", inf)
        model.clearSolver()
    runtime = perf_counter() - began
    status = Status.INTERRUPTED if stopped else STATUS.get(ending, Status.NO_SOLUTION)
    if status is not Status.OPTIMAL:
        bound = inf if status is Status.INFEASIBLE else -inf
        return Result(status, None, inf, bound, runtime)
    column = [v.index for v in program.x.flat]
    x = values[column].reshape(program.x.shape)
    return Result(status, x, value, value, runtime, "HiGHS, linear relaxation")
