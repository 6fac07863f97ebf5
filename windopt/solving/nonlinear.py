"""Nonlinear programs through CasADi's Ipopt, from one start or from several.

Ipopt stops where no small step improves, so its success is LOCALLY_OPTIMAL and carries no bound;
whoever knows one may turn it into a proof. That it finds no feasible point near its start proves
nothing either: only bounds that contradict each other are INFEASIBLE. Every answer is held
against its rows before it counts.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf
from time import perf_counter
from typing import Any, Protocol
from weakref import WeakKeyDictionary

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from windopt.result import Result, Status

Start = NDArray[np.float64]

TOLERANCE = 1e-6  # by which a solution may break a row, in the program's own scale
REUSE = 0.95  # A solver is kept for another time limit that differs by no more than 5 %.

STATUSES = {
    "Solve_Succeeded": Status.LOCALLY_OPTIMAL,
    "Invalid_Problem_Definition": Status.INFEASIBLE,
    "User_Requested_Stop": Status.INTERRUPTED,
    "NonIpopt_Exception_Thrown": Status.INTERRUPTED,  # Ctrl-C during an evaluation
}
REASONS = {
    "Solve_Succeeded": "",
    "Invalid_Problem_Definition": "The bounds of a variable contradict each other.",
    "Infeasible_Problem_Detected": "There is no feasible point near the start.",
    "Maximum_WallTime_Exceeded": "The time limit was reached.",
    "Maximum_Iterations_Exceeded": "The limit of iterations was reached.",
}

_limits: WeakKeyDictionary[ca.Opti, tuple[float, int]] = WeakKeyDictionary()


class NonlinearProgram(Protocol):
    """A CasADi program to be minimised, and its decisions."""

    @property
    def opti(self) -> ca.Opti: ...

    @property
    def x(self) -> ca.MX: ...


def solve(
    program: NonlinearProgram,
    *,
    starts: Sequence[Start] = (),
    time_limit: float = 60.0,
    max_iter: int = 3000,
) -> Result[NDArray[np.float64]]:
    """Minimise ``program``.

    Parameters
    ----------
    starts
        Values of ``program.x`` to search from, one after the other; the best solution counts.
        Empty: the initial guess that the program was given.
    time_limit
        Wall-clock limit over all starts [s]; a deadline that has passed leaves 0 or less.
    max_iter
        Limit of iterations from each start.

    Returns
    -------
    The values of ``program.x``.
    """
    begin = perf_counter()
    best = _none(Status.NO_SOLUTION, REASONS["Maximum_WallTime_Exceeded"])
    for start in starts or (None,):
        left = begin + time_limit - perf_counter()
        if not left > 0:
            break
        try:
            found = _search(program, start, left, max_iter)
        except KeyboardInterrupt:
            found = _none(Status.INTERRUPTED, "")
        if found.objective < best.objective or best.solution is None:
            best = found
        if found.status is Status.INTERRUPTED:
            best = replace(best, status=Status.INTERRUPTED)
            break
    return replace(best, runtime=perf_counter() - begin)


def _search(
    program: NonlinearProgram, start: Start | None, time_limit: float, max_iter: int
) -> Result[NDArray[np.float64]]:
    """Search from one start."""
    opti = program.opti
    _prepare(opti, time_limit, max_iter)
    if start is not None:
        opti.set_initial(program.x, start)
    try:
        opti.solve_limited()
    except RuntimeError as error:
        if "return_status" not in str(error):  # A mistake in the program, not an outcome.
            raise
    ending = opti.return_status()
    status = STATUSES.get(ending, Status.FEASIBLE)
    reason = REASONS.get(ending, f"Ipopt ended with {ending}.")
    if not _feasible(opti):
        claims = status in (Status.LOCALLY_OPTIMAL, Status.FEASIBLE)
        return _none(Status.NO_SOLUTION if claims else status, reason)
    x = np.atleast_1d(opti.debug.value(program.x))
    return Result(status, x, float(opti.debug.value(opti.f)), -inf, 0.0, reason=reason)


def _prepare(opti: ca.Opti, time_limit: float, max_iter: int) -> None:
    """Attach Ipopt with these limits, unless one with nearly the same is attached already.

    Attaching costs more than solving a small program once does.
    """
    known, iterations = _limits.get(opti, (inf, 0))
    if iterations == max_iter and REUSE <= time_limit / known <= 1 / REUSE:
        return
    casadi_options: dict[str, Any] = {
        "print_time": False,
        "detect_simple_bounds": True,  # so that no iterate leaves the bounds of a variable
    }
    ipopt_options: dict[str, Any] = {
        "print_level": 0,
        "sb": "yes",
        "tol": 1e-10,
        "bound_relax_factor": 0.0,  # 1e-8 by default: a cap would be exceeded by as much
        "max_iter": max_iter,
        "max_wall_time": min(time_limit, 1e9),  # Ipopt knows no infinity
    }
    opti.solver("ipopt", casadi_options, ipopt_options)
    _limits[opti] = time_limit, max_iter


def _feasible(opti: ca.Opti) -> bool:
    """Whether the point Ipopt ended at keeps every row."""
    g, lower, upper = (np.atleast_1d(opti.debug.value(row)) for row in (opti.g, opti.lbg, opti.ubg))
    return bool((np.maximum(lower - g, g - upper) <= TOLERANCE).all())  # False for NaN


def _none(status: Status, reason: str) -> Result[NDArray[np.float64]]:
    return Result(status, None, inf, -inf, 0.0, reason=reason)
