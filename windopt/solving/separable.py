"""Separable programs through Ipopt, with the derivatives they bring along."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from time import perf_counter
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from formulations.separable import SeparableProgram
from windopt.result import Result, Status
from windopt.solving.nonlinear import REASONS, STATUSES, TOLERANCE

Floats = NDArray[np.float64]

OPTIONS = {
    "print_level": 0,
    "sb": "yes",
    "bound_relax_factor": 0.0,  # 1e-8 by default: a bound would be exceeded by as much
}


@dataclass(frozen=True, eq=False)
class Search:
    """A program with its functions compiled for Ipopt, to be searched from several starts."""

    program: SeparableProgram
    solver: ca.Function


def solve(
    program: SeparableProgram, *, starts: Sequence[Floats], time_limit: float = 60.0
) -> Result[Floats]:
    """Minimise a program from one start or from several.

    Parameters
    ----------
    program
        What is to be minimised.
    starts
        Values of its variables to search from; the best solution counts.
    time_limit
        Wall-clock limit over all starts [s].

    Returns
    -------
    The values of its variables.
    """
    begin = perf_counter()
    best = Result[Floats](Status.NO_SOLUTION, None, inf, -inf, 0.0)
    for start in starts:
        left = begin + time_limit - perf_counter()
        if not left > 0:
            break
        found = search(prepared(program, time_limit=left), start)
        if found.status is Status.NO_SOLUTION:
            found = replace(found, solution=None, objective=inf)
        if found.objective < best.objective or best.solution is None:
            best = found
        if found.status is Status.INTERRUPTED:
            best = replace(best, status=Status.INTERRUPTED)
            break
    return best.timed(perf_counter() - begin)


def prepared(
    program: SeparableProgram, *, time_limit: float = 60.0, options: Mapping[str, Any] | None = None
) -> Search:
    """Hand a program to Ipopt.

    Parameters
    ----------
    program
        What is to be minimised.
    time_limit
        Wall-clock limit of each search [s].
    options
        Further options of Ipopt, by its own names.
    """
    x, p, sigma = program.x, ca.MX.sym("p", 0), ca.MX.sym("sigma")
    lam = ca.MX.sym("lam", len(program.lower_g))
    f, g = program.f, program.g
    gradient = ca.Function("grad_f", [x, p], [f, program.gradient])
    jacobian = ca.Function("jac_g", [x, p], [g, program.jacobian])
    hessian = ca.Function("hess_lag", [x, p, sigma, lam], [program.hessian(sigma, lam)])
    casadi_options: dict[str, Any] = {
        "print_time": False,
        "error_on_fail": False,
        "show_eval_warnings": False,
        "grad_f": gradient,
        "jac_g": jacobian,
        "hess_lag": hessian,
        "no_nlp_grad": True,
        "ipopt": {**OPTIONS, "max_wall_time": min(max(time_limit, 1e-3), 1e9), **(options or {})},
    }
    nlp: dict[str, Any] = {"x": x, "p": p, "f": f, "g": g}
    return Search(program, ca.nlpsol("search", "ipopt", nlp, casadi_options))


def search(prepared: Search, start: Floats) -> Result[Floats]:
    """Minimise a program from one start.

    Returns
    -------
    The values of its variables. Where rows are broken the status is NO_SOLUTION, but the values at
    which Ipopt ended are there all the same, for whoever can repair them.
    """
    begin = perf_counter()
    program = prepared.program
    found = prepared.solver(
        x0=start,
        lbx=program.lower_x,
        ubx=program.upper_x,
        lbg=program.lower_g,
        ubg=program.upper_g,
    )
    ending = prepared.solver.stats()["return_status"]
    status = STATUSES.get(ending, Status.FEASIBLE)
    reason = REASONS.get(ending, f"Ipopt ended with {ending}.")
    x, g = np.asarray(found["x"]).ravel(), np.asarray(found["g"]).ravel()
    broken = np.maximum(program.lower_g - g, g - program.upper_g).max(initial=0.0)
    if not broken <= TOLERANCE and status in (Status.LOCALLY_OPTIMAL, Status.FEASIBLE):
        status = Status.NO_SOLUTION
    return Result(status, x, float(found["f"]), -inf, perf_counter() - begin, "", reason)
