"""Wake steering: windopt's methods, the paper's rule, and rivals of scipy and FLORIS.

Every set-point is judged by FLORIS itself. Methods run in one process on one processor, with what
does not depend on the farm compiled before: numba's wakes, and CasADi's derivatives of a row.
``python -m benchmarks run yaw --set full`` measures all instances and shows the tables of
:mod:`benchmarks.report.yaw_tables`.
"""

import resource
from collections.abc import Callable, Sequence
from math import inf
from time import perf_counter, process_time

import numpy as np
from numpy.typing import NDArray

from benchmarks.case import Case, Problem, Record
from benchmarks.scipy_yaw import slsqp
from benchmarks.steered_farms import FURTHER, LARGE, LAYOUTS, TURN, SteeredFarm
from windopt.domain.yaw_problem import YawProblem
from windopt.planning.yaw import METHODS as OURS
from windopt.planning.yaw import YawMethod
from windopt.result import Result
from windopt.solving.yaw_schedule import Window, steer_all

Floats = NDArray[np.float64]
Method = Callable[[Sequence[YawProblem], str, float], tuple[Floats, str, float]]
"""Problems, kind of instance and time limit, to misalignments [rad], status and bound [W]."""

INSTANCES = {
    "small": (*LAYOUTS, *FURTHER),
    "medium": LARGE,
    "full": (*LAYOUTS, *FURTHER, *LARGE, "grid20x10-5D-275"),
    "growth": ("row3-5D-272", *(f"grid{n}x{n}-5D-275" for n in (4, 6, 8, 10, 12, 14))),
}
TIME_LIMITS = {"small": 60.0, "medium": 600.0, "full": 600.0, "growth": 600.0}


def by_program(
    problems: Sequence[YawProblem], kind: str, limit: float
) -> tuple[Floats, str, float]:
    """Solve the nonlinear program of each problem, or of all steps at once."""
    if kind == "steps":
        return _answer([steer_all(problems, turn=TURN, time_limit=limit)])
    return one_by_one(OURS["nlp"])(problems, kind, limit)


def one_by_one(search: YawMethod) -> Method:
    """Return a method that takes the problems in turn, and clips steps to what nacelles can do."""

    def in_turn(
        problems: Sequence[YawProblem], kind: str, limit: float
    ) -> tuple[Floats, str, float]:
        deadline = perf_counter() + limit
        found = []
        for problem in problems:
            left = max(0.0, deadline - perf_counter())
            found.append(search(problem, time_limit=left, seed=0))
        yaw, status, bound = _answer(found)
        return _followed(problems, kind, yaw), status, bound

    return in_turn


def in_floris(search: str) -> Method:
    """Return a method of FLORIS, which clips steps afterwards; it has no time limit of its own."""

    def asked(problems: Sequence[YawProblem], kind: str, limit: float) -> tuple[Floats, str, float]:
        from benchmarks import floris_yaw

        yaw = getattr(floris_yaw, search)(problems)
        return _followed(problems, kind, yaw), "feasible", inf

    return asked


METHODS: dict[str, Method] = {
    "nlp": by_program,
    "serial-refine": one_by_one(OURS["serial-refine"]),
    "algorithm-1": one_by_one(OURS["algorithm-1"]),
    "slsqp": one_by_one(slsqp),
    "floris": in_floris("serial_refine"),
    "floris-slsqp": in_floris("slsqp"),
}
ONLY_NAMED = {"floris-slsqp"}
"""Methods that took 12 to 216 s on 25 turbines, and run only where they are asked for."""


def _answer(results: Sequence[Result[Floats]]) -> tuple[Floats, str, float]:
    yaw = np.vstack([result.found() for result in results])
    statuses = dict.fromkeys(str(result.status) for result in results)
    return yaw, ", ".join(statuses), float(np.mean([result.bound for result in results]))


def _followed(problems: Sequence[YawProblem], kind: str, yaw: Floats) -> Floats:
    return Window(problems, TURN).nearest(yaw) if kind == "steps" else yaw


def measure(case: Case) -> Record:
    """Steer a farm, and have FLORIS say what it delivers."""
    instance = SteeredFarm(case.instance)
    problems, method = instance.problems, METHODS[case.method]
    began = process_time()
    yaw, status, bound = method(problems, instance.kind, case.time_limit)
    cpu = process_time() - began
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    from benchmarks.floris_yaw import farm_powers

    power = float(farm_powers(problems, yaw).mean())
    baseline = float(farm_powers(problems, np.zeros_like(yaw)).mean())
    return {
        "status": status,
        "turbines": len(problems[0]),
        "winds": sum(len(problem.weights) for problem in problems),
        "power": round(power, 3),
        "baseline": round(baseline, 3),
        "gain": round(power / baseline - 1, 8),
        "bound": round(bound, 3) if bound < inf else inf,
        "cpu": round(cpu, 4),
        "memory_mb": round(memory),
    }


def warm_up(name: str) -> None:
    """Steer a small farm, which compiles what all farms share."""
    measure(Case("yaw", "row3-5D-272", name, 60.0))


def show(records: Sequence[Record]) -> str:
    """Return windopt's gains and times beside FLORIS's, as text."""
    from benchmarks.report.columns import as_text
    from benchmarks.report.yaw_tables import case_tables, tables

    shown = tables(records) | case_tables(records)
    return "\n\n".join(as_text(title, rows) for title, rows in shown.items())


PROBLEM = Problem(
    instances=INSTANCES.__getitem__,
    methods=lambda chosen: [name for name in METHODS if name not in ONLY_NAMED],
    time_limits=TIME_LIMITS,
    measure=measure,
    warm_up=warm_up,
    show=show,
)
