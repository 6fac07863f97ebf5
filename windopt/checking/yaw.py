"""Checks of yaw set-points under wakes: bounds, caps, and the power the exact model gives them."""

from collections.abc import Iterator
from dataclasses import astuple
from math import degrees, isclose, isfinite

import numpy as np

from windopt.checking.power_coefficient import CONSTANTS, largest_power_coefficient
from windopt.checking.report import Report
from windopt.checking.turbine_yaw import (
    ANGLE_TOLERANCE,
    POWER_TOLERANCE,
    angles,
    check_turbine_yaw,
    most_power,
)
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.power_curve import PowerCurve
from windopt.domain.steering import yaw_problem
from windopt.domain.turbine import TurbineType
from windopt.domain.yaw_problem import YawProblem
from windopt.errors import InvalidInput
from windopt.wakes.farm import expected_yield, farm_power


def check_yaw(plan: YawPlan) -> Report:
    """Recompute every set-point of a plan, under wakes where it was made for them."""
    if plan.steering is None:
        return check_turbine_yaw(plan)
    count = len(plan.set_points)
    if tuple(point.turbine for point in plan.set_points) != plan.farm.names:
        sentence = "the set-points are not those of the farm's turbines, in order"
        return Report((sentence,), set_points=count)
    unreal = [point.turbine for point in plan.set_points if not _finite(point)]
    if unreal:
        return Report(tuple(f"turbine {name}: a value is not a number" for name in unreal))
    try:
        problem = _problem(plan)
    except InvalidInput as error:
        return Report((f"the wakes cannot be recomputed: {error}",), set_points=count)
    return Report(tuple(_violations(plan, problem)), set_points=count)


def power_to_beat(plan: YawPlan) -> float:
    """Return what set-points that face the wind deliver [W]: no bound may lie below."""
    if plan.steering is None:
        return most_power(plan)
    try:
        problem = _problem(plan)
    except InvalidInput:  # said by `check_yaw`
        return 0.0
    return float(farm_power(problem, problem.facing))


def _finite(point: SetPoint) -> bool:
    return all(isfinite(v) for v in astuple(point) if isinstance(v, float | int))


def _problem(plan: YawPlan) -> YawProblem:
    assert plan.steering is not None  # asked by those who call
    return yaw_problem(plan.farm, plan.wind, plan.steering, _curve, air_density=plan.air_density)


def _curve(type_: TurbineType) -> PowerCurve:
    if type_.curve is None and type_.power_coefficient not in CONSTANTS:
        raise InvalidInput("C_p model", "to be known", type_.power_coefficient)
    return type_.curve or type_.curve_by(largest_power_coefficient(type_.power_coefficient))


def _violations(plan: YawPlan, problem: YawProblem) -> Iterator[str]:
    gamma = np.array([point.misalignment for point in plan.set_points])
    if (np.abs(gamma) >= np.pi / 2).any():
        yield "a rotor is turned by 90 deg or more"
        return
    found = expected_yield(problem, gamma)
    most = problem.weights @ problem.unwaked
    for i, point in enumerate(plan.set_points):
        for sentence in (
            *angles(point, plan),
            *_bounds(point, plan),
            *_yield(point, float(found.speeds[i]), float(found.powers[i]), float(most[i])),
        ):
            yield f"turbine {point.turbine}: {sentence}"
    if plan.power > problem.farm_cap * (1 + POWER_TOLERANCE):
        yield f"{plan.power:.9g} W are delivered, more than the farm's cap"
    baseline = float(farm_power(problem, np.zeros(len(problem))))
    if not isclose(plan.power_baseline, baseline, rel_tol=POWER_TOLERANCE, abs_tol=1e-3):
        yield (
            f"a power of {plan.power_baseline:.9g} W is said for every nacelle facing the wind, "
            f"{baseline:.9g} W is found"
        )


def _bounds(point: SetPoint, plan: YawPlan) -> Iterator[str]:
    assert plan.steering is not None
    lower, upper = plan.steering.lower, plan.steering.upper
    if not lower - ANGLE_TOLERANCE <= point.misalignment <= upper + ANGLE_TOLERANCE:
        said, low, high = (degrees(angle) for angle in (point.misalignment, lower, upper))
        yield f"a misalignment of {said:.6g} deg is outside its bounds, {low:g} to {high:g} deg"
    if point.pitch is not None or point.tip_speed_ratio is not None:
        yield "a pitch or tip-speed ratio is said, which wakes leave to the turbine's controller"


def _yield(point: SetPoint, speed: float, power: float, most: float) -> Iterator[str]:
    """Hold what the set-point says against the exact model."""
    for name, unit, said, is_so in (
        ("wind", "m/s", point.wind_speed, speed),
        ("power", "W", point.power, power),
        ("certified maximum", "W", point.maximum, most),
    ):
        if not isclose(said, is_so, rel_tol=POWER_TOLERANCE, abs_tol=1e-3):
            yield f"a {name} of {said:.9g} {unit} is said, {is_so:.9g} {unit} is found"
