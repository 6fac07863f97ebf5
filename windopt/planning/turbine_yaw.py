"""The paper's yaw problem: each turbine of a farm by itself, in the free wind and without wakes.

Turbines become programs, and their solutions set-points. Without wakes the most that a turbine
can deliver is known beforehand, min(rated, 1/2 rho A w^3 C_p,max), and the sum over the farm is a
bound that can prove a plan optimal. It is also what it delivers with every nacelle facing the wind.

The program decides the yaw. Above the rated power, pitch and tip-speed ratio are free along a
curve, and set-points take the point of it that keeps the rotor at its rated speed.
"""

import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isnan, nan, pi, radians, remainder
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from formulations.rotor import MODELS, PITCH, TIP_SPEED_RATIO, OperatingPoint, PowerCoefficient
from formulations.rotor import operating_point as pitch_controlled
from formulations.turbine_yaw import TurbineYaw, turbine_yaw
from windopt.domain.farm import Farm
from windopt.domain.plan import SetPoint, YawPlan
from windopt.domain.turbine import TurbineType, require_positive
from windopt.domain.wind import Wind
from windopt.domain.yaw_problem import GAP
from windopt.errors import InvalidInput, require_kind, require_one_of
from windopt.heuristics.algorithm_1 import algorithm_1, exceeds_rated
from windopt.result import Result, Status
from windopt.solving import nonlinear

METHODS = ("nlp", "algorithm-1")
POWER_COEFFICIENTS = tuple(MODELS)
"""C_p models by the names they are chosen by."""
AIR_DENSITY = 1.065
"""The paper's air density [kg/m3]."""
FURTHER_STARTS = 8
FEATHERED = 90.0  # deg
# CasADi's programs keep their last solution, and its references are not counted safely.
_CASADI = threading.Lock()
BOUND_SOURCE = "sum over the turbines of min(rated power, 1/2 rho A w^3 C_p,max)"


@dataclass(frozen=True)
class _Case:
    """One kind of turbine in one wind; turbines of the same case are decided once."""

    type: TurbineType
    gamma_0: float
    w: float
    rho: float

    def __post_init__(self) -> None:
        require_one_of("power_coefficient", self.type.power_coefficient, MODELS)

    @property
    def model(self) -> PowerCoefficient:
        return MODELS[self.type.power_coefficient]

    @property
    def limits(self) -> dict[str, float]:
        A, p_rated = self.type.swept_area, self.type.rated_power
        return {"w": self.w, "rho": self.rho, "A": A, "p_rated": p_rated}

    @property
    def running(self) -> bool:
        return self.type.cut_in <= self.w < self.type.cut_out

    @property
    def maximum(self) -> float:
        """The most that any set-point delivers [W]: what one facing the wind does."""
        return self.facing(0.0).power if self.running else 0.0

    def facing(self, gamma: float) -> OperatingPoint:
        """How the turbine runs at a misalignment [rad]."""
        return pitch_controlled(self.model, gamma, **self.limits)

    def by_rule(self) -> OperatingPoint:
        """How the paper's rule runs it; parked, with its yaw held, where there is no power."""
        if not self.running:
            return OperatingPoint(self.gamma_0, 0.0, FEATHERED, 0.0)
        return algorithm_1(self.model, self.gamma_0, **self.limits)

    @property
    def kept_by_rule(self) -> bool:
        """Whether the paper's rule keeps the old yaw."""
        return self.running and exceeds_rated(self.model, 0.0, **self.limits)

    @property
    def needs_pitch(self) -> bool:
        """Whether that would exceed the rated power."""
        return self.kept_by_rule and exceeds_rated(self.model, self.gamma_0, **self.limits)


def plan_turbine_yaw(
    farm: Farm,
    wind: Wind,
    *,
    method: str = "nlp",
    nacelle: float | Sequence[float] | None = None,
    air_density: float = AIR_DENSITY,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[YawPlan]:
    """Set every turbine's yaw, pitch and tip-speed ratio for the most power up to rated.

    Of the yaws that deliver the same power, the nearest to the nacelle's present direction is
    taken. Below cut-in and from cut-out on turbines are parked: feathered, with their yaw held.

    Parameters
    ----------
    farm
        The wind farm. Turbines follow their C_p models, whatever curves they may have: the paper's
        problem decides pitch and tip-speed ratio too, of which curves say nothing.
    wind
        The steady wind.
    method
        ``"nlp"`` solves the program of :mod:`formulations.turbine_yaw`, ``"algorithm-1"`` is the
        paper's rule, :mod:`windopt.heuristics.algorithm_1`.
    nacelle
        Where the nacelles face at present, clockwise from north [rad]: one direction for all
        turbines, or one for each. ``None``: into the wind.
    air_density
        Rho [kg/m3].
    time_limit
        Wall-clock limit [s]. Turbines not decided by then take the set-point of the paper's rule.
    seed
        Seed of further starts, drawn where the first does not reach the bound.

    Raises
    ------
    InvalidInput
        If an option cannot be used, or a turbine names an unknown power coefficient.
    """
    require_kind("farm", farm, Farm)
    require_kind("wind", wind, Wind)
    begin = perf_counter()
    require_one_of("method", method, METHODS)
    if isnan(time_limit) or time_limit < 0:
        raise InvalidInput("time_limit", ">= 0 s", time_limit)
    require_positive("air_density", air_density)

    misalignments = present_misalignments(len(farm), wind, nacelle)
    cases = [
        _Case(turbine.type, gamma_0, wind.speed, air_density)
        for turbine, gamma_0 in zip(farm.turbines, misalignments, strict=True)
    ]
    points = {case: case.by_rule() for case in cases}
    if method == "nlp":
        status, reason = _improve(points, begin + time_limit, seed)
    else:
        status, reason = Status.FEASIBLE, _verdict(cases)

    set_points = tuple(
        _set_point(name, wind, points[case], case.maximum)
        for name, case in zip(farm.names, cases, strict=True)
    )
    bound = sum(point.maximum for point in set_points)
    plan = YawPlan(farm, wind, set_points, power_baseline=bound, air_density=air_density)
    if bound - plan.power <= GAP * bound and status is not Status.INTERRUPTED:
        status = Status.OPTIMAL
    runtime = perf_counter() - begin
    return Result(status, plan, plan.power, bound, runtime, BOUND_SOURCE, reason)


def present_misalignments(
    n: int, wind: Wind, nacelle: float | Sequence[float] | None
) -> list[float]:
    """Return the present misalignment of each of ``n`` turbines [rad], in [-pi, pi)."""
    if nacelle is None:
        return [0.0] * n
    directions: NDArray[np.float64] = np.asarray(nacelle, dtype=float)
    if directions.shape not in ((), (n,)):
        raise InvalidInput("nacelle", f"to be one direction or {n}", directions.shape)
    if not np.isfinite(directions).all():
        raise InvalidInput("nacelle", "to be finite", nan)
    turned = (remainder(wind.theta_met - d, 2 * pi) for d in np.broadcast_to(directions, n))
    return [gamma if gamma < pi else -pi for gamma in turned]


def _improve(points: dict[_Case, OperatingPoint], deadline: float, seed: int) -> tuple[Status, str]:
    """Replace the operating points of running turbines by those of the program."""
    left = ""
    for case in points:
        if not case.running:
            continue
        with _CASADI:
            found = _solve(case, deadline, seed)
        if found.solution is not None:
            points[case] = found.solution
        else:
            left = f"Some turbines follow the paper's rule. {found.reason}".strip()
        if found.status is Status.INTERRUPTED:
            return found.status, "Turbines not decided before the stop follow the paper's rule."
    return (Status.FEASIBLE if left else Status.LOCALLY_OPTIMAL), left


def _solve(case: _Case, deadline: float, seed: int) -> Result[OperatingPoint]:
    """Solve one turbine's program, from further starts until one reaches the bound."""
    program = _program(case.type, case.rho)
    program.opti.set_value(program.w, case.w)
    program.opti.set_value(program.gamma_0, case.gamma_0)
    best: Result[OperatingPoint] | None = None
    for start in _starts(program, seed):
        result = nonlinear.solve(program, starts=[start], time_limit=deadline - perf_counter())
        x = result.solution
        found = result.carrying(None if x is None else case.facing(float(x[0])))
        if best is None or _power(found) > _power(best):
            best = found
        stopped = found.status is Status.INTERRUPTED or perf_counter() >= deadline
        if stopped or _power(best) >= (1 - GAP) * case.maximum:
            break
    assert best is not None  # there is at least one start
    return best


def _power(result: Result[OperatingPoint]) -> float:
    return -1.0 if result.solution is None else result.solution.power


@lru_cache(maxsize=64)
def _program(turbine_type: TurbineType, rho: float) -> TurbineYaw:
    """Build the program of a turbine type once, for all winds to come."""
    model = MODELS[turbine_type.power_coefficient]
    return turbine_yaw(model, rho=rho, A=turbine_type.swept_area, p_rated=turbine_type.rated_power)


def _starts(program: TurbineYaw, seed: int) -> Iterator[NDArray[np.float64]]:
    yield program.start
    rng = np.random.default_rng(seed)
    low, high = np.array([(-pi / 2, pi / 2), TIP_SPEED_RATIO, PITCH, (0, 1), (0, 1)]).T
    for _ in range(FURTHER_STARTS):
        yield rng.uniform(low, high)


def _set_point(name: str, wind: Wind, point: OperatingPoint, maximum: float) -> SetPoint:
    return SetPoint(
        turbine=name,
        nacelle=(wind.theta_met - point.gamma) % (2 * pi) % (2 * pi),  # -1e-17 % 2 pi is 2 pi
        misalignment=point.gamma,
        pitch=radians(point.beta),
        tip_speed_ratio=point.lam,
        wind_speed=wind.speed,
        power=point.power,
        maximum=maximum,
    )


def _verdict(cases: Sequence[_Case]) -> str:
    """Say what the paper's rule did, turbine by turbine."""
    kept = [case for case in cases if case.kept_by_rule]
    wasted = sum(case.maximum - case.by_rule().power for case in kept)
    exceeding = sum(case.needs_pitch for case in kept)
    return (
        f"The paper's rule kept the old yaw of {len(kept)} of {len(cases)} turbines, which wastes "
        f"{wasted / 1e6:.6g} MW; {exceeding} would exceed their rated power without pitch control."
    )
