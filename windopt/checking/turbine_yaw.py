"""Checks of set-points without wakes: angles, limits, and the power they really give."""

from collections.abc import Iterator
from dataclasses import astuple
from math import cos, degrees, isclose, isfinite, pi

from windopt.checking.power_coefficient import (
    CONSTANTS,
    PITCH,
    TIP_SPEED_RATIO,
    largest_power_coefficient,
    power_coefficient,
)
from windopt.checking.report import Report
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.turbine import Turbine

ANGLE_TOLERANCE = 1e-6  # rad; a nacelle's encoder resolves some 1e-3
POWER_TOLERANCE = 1e-6  # of rated power; what is asked of the solver
BETZ = 16 / 27
FEATHERED = 90.0  # deg


def check_turbine_yaw(plan: YawPlan) -> Report:
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
    facing = most_power(plan)
    if not isclose(plan.power_baseline, facing, rel_tol=POWER_TOLERANCE):
        violations.append(
            f"a power of {plan.power_baseline:.9g} W is said for every nacelle facing the wind, "
            f"{facing:.9g} W is found"
        )
    return Report(tuple(violations), set_points=len(plan.set_points))


def most_power(plan: YawPlan) -> float:
    """Return what the farm delivers with every nacelle facing the wind [W].

    Without wakes no set-points deliver more. Turbines of an unknown C_p model count nothing.
    """
    return sum(_most_power(turbine, plan) for turbine in plan.farm.turbines)


def _most_power(turbine: Turbine, plan: YawPlan) -> float:
    model = turbine.type.power_coefficient
    if not _runs(turbine, plan) or model not in CONSTANTS:
        return 0.0
    free = _power_of_the_wind(plan.wind.speed, turbine, plan)
    return min(turbine.type.rated_power, free * largest_power_coefficient(model))


def _runs(turbine: Turbine, plan: YawPlan) -> bool:
    return turbine.type.cut_in <= plan.wind.speed < turbine.type.cut_out


def _power_of_the_wind(speed: float, turbine: Turbine, plan: YawPlan) -> float:
    """Return 1/2 rho A w^3 [W], infinite rather than an error where it is too large."""
    return 0.5 * plan.air_density * turbine.type.swept_area * speed * speed * speed


def _set_point(point: SetPoint, turbine: Turbine, plan: YawPlan) -> Iterator[str]:
    if point.pitch is None or point.tip_speed_ratio is None:
        yield "neither pitch nor tip-speed ratio may be left out without wakes"
        return
    numbers = (value for value in astuple(point) if not isinstance(value, str))
    if not all(isfinite(value) for value in numbers):
        yield "a value is not a number"
        return
    yield from angles(point, plan)
    yield from _free_wind(point, plan)
    yield from _limits(point, turbine, plan)
    outside = tuple(_rotor(point.pitch, point.tip_speed_ratio))
    yield from outside
    if not outside:  # there the models have poles
        yield from _power(point, point.pitch, point.tip_speed_ratio, turbine, plan)


def angles(point: SetPoint, plan: YawPlan) -> Iterator[str]:
    """Yield what is wrong with the directions of a nacelle."""
    if not -ANGLE_TOLERANCE <= point.nacelle <= 2 * pi + ANGLE_TOLERANCE:
        yield f"the nacelle's direction of {degrees(point.nacelle):.6g} deg is not on the compass"
    if plan.wind.speed > 0:
        misalignment = (plan.wind.theta_met - point.nacelle + pi) % (2 * pi) - pi
        distance = abs(misalignment - point.misalignment)
        if min(distance, 2 * pi - distance) > ANGLE_TOLERANCE:
            said, found = degrees(point.misalignment), degrees(misalignment)
            yield f"a misalignment of {said:.6g} deg is said, {found:.6g} deg is found"


def _free_wind(point: SetPoint, plan: YawPlan) -> Iterator[str]:
    if not isclose(point.wind_speed, plan.wind.speed, rel_tol=1e-9, abs_tol=1e-9):
        yield f"its wind of {point.wind_speed:.6g} m/s is not the free {plan.wind.speed:.6g} m/s"


def _limits(point: SetPoint, turbine: Turbine, plan: YawPlan) -> Iterator[str]:
    rated = turbine.type.rated_power
    free = _power_of_the_wind(plan.wind.speed, turbine, plan)
    least = _most_power(turbine, plan)
    if not 0 <= point.power <= rated:
        yield f"its power of {point.power:.9g} W is not between 0 and the rated {rated:.9g} W"
    if point.power > 0 and not _runs(turbine, plan):
        yield f"it delivers power in {plan.wind.speed:.6g} m/s, outside cut-in and cut-out"
    if point.power > point.maximum * (1 + POWER_TOLERANCE):
        yield f"its power of {point.power:.9g} W is above its certified {point.maximum:.9g} W"
    if point.maximum > min(rated, BETZ * free) * (1 + POWER_TOLERANCE):
        yield f"its certified {point.maximum:.9g} W is above rated power or the Betz limit"
    if point.maximum < least * (1 - POWER_TOLERANCE):
        yield f"its certified {point.maximum:.9g} W is below the {least:.9g} W it can deliver"


def _rotor(pitch: float, tip_speed_ratio: float) -> Iterator[str]:
    """Pitch and tip-speed ratio: where the C_p models hold, or parked."""
    if _parked(pitch, tip_speed_ratio):
        return
    if not _within(TIP_SPEED_RATIO, tip_speed_ratio):
        yield f"its tip-speed ratio of {tip_speed_ratio:.6g} is not between 1 and 15"
    if not _within(PITCH, degrees(pitch)):
        yield f"its pitch of {degrees(pitch):.6g} deg is not between 0 and 30 deg"


def _within(limits: tuple[float, float], value: float) -> bool:
    low, high = limits
    return low - ANGLE_TOLERANCE <= value <= high + ANGLE_TOLERANCE


def _parked(pitch: float, tip_speed_ratio: float) -> bool:
    """Whether the rotor stands still, its blades feathered."""
    return tip_speed_ratio == 0 and isclose(degrees(pitch), FEATHERED, rel_tol=1e-9)


def _power(
    point: SetPoint, pitch: float, tip_speed_ratio: float, turbine: Turbine, plan: YawPlan
) -> Iterator[str]:
    """Hold the power said against what pitch, tip-speed ratio and misalignment give."""
    if turbine.type.power_coefficient not in CONSTANTS:
        yield f"its C_p model {turbine.type.power_coefficient} is unknown"
        return
    power = 0.0
    if _runs(turbine, plan) and not _parked(pitch, tip_speed_ratio):
        effective = plan.wind.speed * max(0.0, cos(point.misalignment))
        C_p = power_coefficient(turbine.type.power_coefficient, tip_speed_ratio, degrees(pitch))
        power = _power_of_the_wind(effective, turbine, plan) * C_p
    if not abs(power - point.power) <= POWER_TOLERANCE * turbine.type.rated_power:
        yield f"a power of {point.power:.9g} W is said, its set-point gives {power:.9g} W"
