"""Checks of yaw set-points: angles, limits, and the power they really give."""

from collections.abc import Iterator
from math import cos, degrees, isclose, isfinite, pi

from windopt.checking.power_coefficient import CONSTANTS, power_coefficient
from windopt.checking.report import Report
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.turbine import Turbine

ANGLE_TOLERANCE = 1e-6  # rad; a nacelle's encoder resolves some 1e-3
POWER_TOLERANCE = 1e-6  # of rated power; what is asked of the solver
BETZ = 16 / 27


def check_yaw(plan: YawPlan) -> Report:
    """Recompute every set-point of a plan."""
    violations = []
    names = tuple(point.turbine for point in plan.set_points)
    if names != plan.farm.names:
        violations.append("the set-points are not those of the farm's turbines, in order")
    turbines = {turbine.name: turbine for turbine in plan.farm.turbines}
    for point in plan.set_points:
        if turbine := turbines.get(point.turbine):
            violations += [
                f"turbine {point.turbine}: {s}" for s in _set_point(point, turbine, plan)
            ]
    return Report(tuple(violations), set_points=len(plan.set_points))


def _set_point(point: SetPoint, turbine: Turbine, plan: YawPlan) -> Iterator[str]:
    values = (point.nacelle, point.misalignment, point.pitch, point.tip_speed_ratio, point.power)
    if not all(isfinite(value) for value in values):
        yield "a value is not a number"
        return
    yield from _angles(point, plan)
    yield from _limits(point, turbine, plan)
    yield from _power(point, turbine, plan)


def _angles(point: SetPoint, plan: YawPlan) -> Iterator[str]:
    if not -ANGLE_TOLERANCE <= point.nacelle <= 2 * pi + ANGLE_TOLERANCE:
        yield f"the nacelle's direction of {degrees(point.nacelle):.6g} deg is not on the compass"
    if not isclose(point.wind_speed, plan.wind.speed, rel_tol=1e-9, abs_tol=1e-9):
        yield f"its wind of {point.wind_speed:.6g} m/s is not the free {plan.wind.speed:.6g} m/s"
    if plan.wind.speed > 0:
        misalignment = (plan.wind.theta_met - point.nacelle + pi) % (2 * pi) - pi
        distance = abs(misalignment - point.misalignment)
        if min(distance, 2 * pi - distance) > ANGLE_TOLERANCE:
            said, found = degrees(point.misalignment), degrees(misalignment)
            yield f"a misalignment of {said:.6g} deg is said, {found:.6g} deg is found"


def _limits(point: SetPoint, turbine: Turbine, plan: YawPlan) -> Iterator[str]:
    rated = turbine.type.rated_power
    running = turbine.type.cut_in <= point.wind_speed < turbine.type.cut_out
    free = 0.5 * plan.air_density * turbine.type.swept_area * _cube(point.wind_speed)
    if not 0 <= point.power <= rated:
        yield f"its power of {point.power:.9g} W is not between 0 and the rated {rated:.9g} W"
    if point.power > 0 and not running:
        yield f"it delivers power in {point.wind_speed:.6g} m/s, outside cut-in and cut-out"
    if point.power > point.maximum * (1 + POWER_TOLERANCE):
        yield f"its power of {point.power:.9g} W is above its certified {point.maximum:.9g} W"
    if point.maximum > min(rated, BETZ * free) * (1 + POWER_TOLERANCE):
        yield f"its certified {point.maximum:.9g} W is above rated power or the Betz limit"


def _power(point: SetPoint, turbine: Turbine, plan: YawPlan) -> Iterator[str]:
    """Hold the power said against what pitch, tip-speed ratio and misalignment give."""
    if point.power == 0:
        return
    if turbine.type.power_coefficient not in CONSTANTS:
        yield f"its C_p model {turbine.type.power_coefficient} is unknown"
        return
    effective = plan.wind.speed * max(0.0, cos(point.misalignment))
    C_p = power_coefficient(
        turbine.type.power_coefficient, point.tip_speed_ratio, degrees(point.pitch)
    )
    power = 0.5 * plan.air_density * turbine.type.swept_area * _cube(effective) * C_p
    if abs(power - point.power) > POWER_TOLERANCE * turbine.type.rated_power:
        yield f"a power of {point.power:.9g} W is said, its set-point gives {power:.9g} W"


def _cube(speed: float) -> float:
    """Return the cube, infinite rather than an error where it is too large for a float."""
    return speed * speed * speed
