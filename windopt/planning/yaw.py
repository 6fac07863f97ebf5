"""Wake steering: a farm in a wind becomes a yaw problem, and misalignments become set-points.

Every method takes the same problem and is judged by the exact model of :mod:`windopt.wakes`. No
misalignment lets a turbine deliver more than it does unwaked, so the sum of that over the farm is a
proven bound; it is reached where the wind is strong enough for all to run at rated power. Elsewhere
:mod:`windopt.solving.yaw_bound` comes closer, whatever the method.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import isnan, pi
from time import perf_counter
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from formulations.rotor import MODELS
from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.power_curve import STANDARD_AIR_DENSITY, PowerCurve
from windopt.domain.steering import Steering, yaw_problem
from windopt.domain.turbine import TurbineType, require_positive
from windopt.domain.wind import Wind
from windopt.domain.yaw_problem import GAP, YawProblem
from windopt.errors import FailedCheck, InvalidInput, require_kind, require_one_of
from windopt.heuristics.algorithm_1 import face_or_hold
from windopt.heuristics.serial_refine import serial_refine
from windopt.planning.turbine_yaw import present_misalignments
from windopt.result import Result, Status
from windopt.solving.farm_yaw import steer
from windopt.solving.yaw_bound import UNWAKED, closest_bound
from windopt.wakes.farm import expected_yield, farm_power

Floats = NDArray[np.float64]


class YawMethod(Protocol):
    """What every method of wake steering is: a problem in, misalignments [rad] out."""

    def __call__(
        self, problem: YawProblem, *, time_limit: float, seed: int
    ) -> Result[NDArray[np.float64]]: ...


METHODS: dict[str, YawMethod] = {
    "nlp": steer,
    "serial-refine": serial_refine,
    "algorithm-1": face_or_hold,
}
"""Methods by the name they are chosen by."""
DEFAULT_METHOD = "nlp"


def method_named(name: str) -> YawMethod:
    """Return the method of this name.

    Raises
    ------
    InvalidInput
        If there is none.
    """
    require_one_of("method", name, METHODS)
    return METHODS[name]


def plan_yaw(
    farm: Farm,
    wind: Wind,
    *,
    method: str = DEFAULT_METHOD,
    steering: Steering | None = None,
    nacelle: float | Sequence[float] | None = None,
    air_density: float = STANDARD_AIR_DENSITY,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[YawPlan]:
    """Turn the rotors of a farm so that, under each other's wakes, they deliver the most power.

    Parameters
    ----------
    farm
        The wind farm.
    wind
        The steady wind, or the one about which it scatters.
    method
        ``"nlp"`` solves the program of :mod:`formulations.farm_yaw` from where a search rotor by
        rotor ends, ``"serial-refine"`` is FLORIS's heuristic, ``"algorithm-1"`` the paper's rule,
        which does not know of wakes.
    steering
        Turbulence, bounds, the wind's scatter and the farm's cap; FLORIS's usual ones by default.
    nacelle
        Where the nacelles face at present, clockwise from north [rad]: one direction for all
        turbines, or one for each. ``None``: into the wind.
    air_density
        Rho [kg/m3].
    time_limit
        Wall-clock limit [s].
    seed
        Of whatever is drawn at random.

    Raises
    ------
    InvalidInput
        If the farm or the wind is not one, an option cannot be used, or a turbine names an unknown
        power coefficient.
    FailedCheck
        If the set-points do not stand up to the independent checker.
    """
    require_kind("farm", farm, Farm)
    require_kind("wind", wind, Wind)
    begin = perf_counter()
    search = method_named(method)
    if isnan(time_limit) or time_limit < 0:
        raise InvalidInput("time_limit", ">= 0 s", time_limit)
    require_positive("air_density", air_density)
    steering = steering or Steering()
    present = np.array(present_misalignments(len(farm), wind, nacelle))
    problem = yaw_problem(farm, wind, steering, curve_of, air_density=air_density, present=present)
    found = search(problem, time_limit=time_limit, seed=seed)
    found = closely_bounded(problem, found, time_limit=begin + time_limit - perf_counter())
    result = judged_plan(farm, wind, problem, steering, found)
    return result.timed(perf_counter() - begin)


def closely_bounded(
    problem: YawProblem, found: Result[Floats], *, time_limit: float
) -> Result[Floats]:
    """Return what a method found with the closest bound, where the method did not look for it.

    Parameters
    ----------
    problem
        The farm's yaw problem, which alone decides the bound.
    found
        Misalignments [rad], and what is known of them.
    time_limit
        Time left [s]; with none, the bound is not looked for.
    """
    proved = found.objective >= (1 - GAP) * problem.bound
    stopped = found.status is Status.INTERRUPTED or time_limit <= 0
    if proved or stopped or found.bound < problem.bound:
        return found
    try:
        bound, source = closest_bound(problem)
    except KeyboardInterrupt:
        return replace(found, status=Status.INTERRUPTED)
    return replace(found, bound=bound, bound_source=source)


def judged_plan(
    farm: Farm, wind: Wind, problem: YawProblem, steering: Steering, found: Result[Floats]
) -> Result[YawPlan]:
    """Return the set-points of what a method found, judged by the exact model and checked.

    Parameters
    ----------
    problem
        The farm's yaw problem in this wind, under this steering.
    found
        Misalignments [rad], shape ``(n,)``; where there are none, the rotors face the wind.

    Raises
    ------
    FailedCheck
        If the set-points do not stand up to the independent checker.
    """
    gamma = problem.facing if found.solution is None else found.solution
    plan = _plan(farm, wind, problem, steering, gamma)
    bound = min(problem.bound, found.bound) if found.bound >= plan.power else problem.bound
    source = found.bound_source if bound < problem.bound else UNWAKED
    status, reason = found.status, found.reason
    if status in (Status.NO_SOLUTION, Status.INFEASIBLE):
        status = Status.FEASIBLE
    if bound - plan.power <= GAP * bound and status is not Status.INTERRUPTED:
        status, reason = Status.OPTIMAL, ""
    result = Result(status, plan, plan.power, bound, found.runtime, source, reason)
    report = check(result)
    if not report.passed:
        raise FailedCheck(report.violations)
    return result


def curve_of(type_: TurbineType) -> PowerCurve:
    """Return a turbine's power curve, from its C_p model where none is published."""
    name = type_.power_coefficient
    if type_.curve is None:
        require_one_of("power_coefficient", name, MODELS)
    return type_.curve or type_.curve_by(MODELS[name].best().C_p)


def problem_of(plan: YawPlan) -> YawProblem:
    """Return the yaw problem that a plan under wakes answers.

    Raises
    ------
    InvalidInput
        If the plan was made without wakes.
    """
    if plan.steering is None:
        raise InvalidInput("plan", "to be made under wakes", "one of turbines by themselves")
    return yaw_problem(plan.farm, plan.wind, plan.steering, curve_of, air_density=plan.air_density)


def _plan(
    farm: Farm, wind: Wind, problem: YawProblem, steering: Steering, gamma: Floats
) -> YawPlan:
    """Return the set-points of these misalignments, as the exact model judges them."""
    judged = expected_yield(problem, gamma)
    columns = gamma, judged.speeds, judged.powers, problem.weights @ problem.unwaked
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return YawPlan(
        farm,
        wind,
        tuple(
            SetPoint(
                name,
                nacelle=(wind.theta_met - angle) % (2 * pi) % (2 * pi),  # -1e-17 % 2 pi is 2 pi
                misalignment=angle,
                pitch=None,
                tip_speed_ratio=None,
                wind_speed=speed,
                power=power,
                maximum=maximum,
            )
            for name, (angle, speed, power, maximum) in zip(farm.names, rows, strict=True)
        ),
        power_baseline=float(farm_power(problem, np.zeros(len(farm)))),
        air_density=problem.air_density,
        steering=steering,
    )
