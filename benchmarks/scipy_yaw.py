"""SLSQP of scipy on the exact wakes: the rival that a user of scipy would write.

FLORIS has the same algorithm, ``YawOptimizationScipy``, which starts where the rotors face the wind
and asks FLORIS for one farm power at a time, differences included. This one starts from either side
and asks windopt's twin of the same wakes for all differences at once. On the five instances that
both were measured on it was the quicker, and gained as much or more; FLORIS's own took 12 to 216 s
of a processor on the four of them with 25 turbines.
"""

from math import inf, radians
from time import perf_counter

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, minimize

from windopt.domain.yaw_problem import YawProblem
from windopt.result import Result, Status
from windopt.solving.yaw_bound import UNWAKED
from windopt.wakes.farm import farm_power

Floats = NDArray[np.float64]

ASIDE = radians(5.0)
"""Yaw of the two starts, to either side."""
STEP = 1e-4
"""Of the differences [rad]: less than the wakes' steps, more than their rounding."""
MOST_ITERATIONS = 200


def slsqp(problem: YawProblem, *, time_limit: float = inf, seed: int = 0) -> Result[Floats]:
    """Climb from yaws to either side by sequential quadratic programs, and keep the better end.

    Parameters
    ----------
    problem
        The farm and its winds.
    time_limit
        Wall-clock limit [s].
    seed
        Ignored: nothing is drawn at random.

    Returns
    -------
    Misalignments [rad], shape ``(n,)``.
    """
    begin = perf_counter()
    starts = [np.full(len(problem), side * ASIDE) for side in (1, -1)]
    ends = np.array([_climbed(problem, start, begin + time_limit) for start in starts])
    powers = farm_power(problem, ends)
    best = int(powers.argmax())
    runtime = perf_counter() - begin
    return Result(Status.FEASIBLE, ends[best], float(powers[best]), problem.bound, runtime, UNWAKED)


def _climbed(problem: YawProblem, start: Floats, deadline: float) -> Floats:
    """Return where SLSQP ends, or is when its time is over."""
    aside = np.vstack([np.zeros(len(problem)), STEP * np.eye(len(problem))])

    def lost(yaw: Floats) -> tuple[float, Floats]:
        shares = 1.0 - farm_power(problem, yaw + aside) / problem.bound
        return float(shares[0]), (shares[1:] - shares[0]) / STEP

    def until_deadline(xk: Floats) -> None:
        if perf_counter() >= deadline:
            raise StopIteration

    found = minimize(
        lost,
        np.clip(start, problem.lower, problem.upper),
        method="SLSQP",
        jac=True,
        bounds=Bounds(problem.lower, problem.upper),
        callback=until_deadline,
        options={"maxiter": MOST_ITERATIONS, "ftol": 1e-9},
    )
    end: Floats = np.clip(found.x, problem.lower, problem.upper)
    return end
