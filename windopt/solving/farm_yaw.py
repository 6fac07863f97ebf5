"""Wake steering by the nonlinear program: find a good start, climb, and judge by the exact wakes.

The program has many local optima, and its smooth model rounds what the exact one counts in steps.
So the search goes from the coarse to the fine: rotor by rotor over their whole ranges
(:mod:`windopt.solving.rotor_by_rotor`), then all rotors at once by Ipopt on the lifted program
(:mod:`formulations.farm_yaw`), then rotor by rotor again within a few degrees. Small farms are
searched from 5 degrees to either side too; from zero yaw no search starts, for in a wind along a
row it satisfies the first-order conditions without being a maximum. What counts is the exact power,
and only misalignments near a point at which Ipopt converged are called locally optimal.
"""

from collections.abc import Iterator, Mapping, Sequence
from math import radians
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formulations import farm_yaw as lifted
from formulations.farm_in_wind import FarmInWind
from formulations.farm_wakes import wakes
from formulations.power_curve import Curve
from windopt.domain.yaw_problem import GAP, YawProblem
from windopt.result import Result, Status
from windopt.solving.interrupts import uninterrupted
from windopt.solving.rotor_by_rotor import refine
from windopt.solving.separable import prepared, search
from windopt.solving.wake_sweep import Sweep
from windopt.solving.yaw_bound import UNWAKED, closest_bound
from windopt.wakes.farm import farm_power

Floats = NDArray[np.float64]

SMALL = 12
"""Turbines times winds up to which further starts cost little."""

ASIDE = radians(5.0)
"""Yaw of the further starts."""

FINE = radians(5.0)
"""How far the last passes look to either side of each rotor."""

FROM_AFAR: Mapping[str, float] = {"tol": 1e-6, "max_iter": 100}
FROM_NEARBY = {
    **FROM_AFAR,
    "mu_init": 1e-6,
    "bound_push": 1e-4,
    "bound_frac": 1e-4,
}
"""Options of Ipopt: a good start is not to be pushed away by bounds or their barrier."""

NEARBY = (
    "Ipopt converged within 5 deg of these set-points, which by the exact wakes deliver no less."
)
FAR = "By the exact wakes these set-points deliver more than any point at which Ipopt converged."
NOT_CONVERGED = (
    "Ipopt did not converge: {} Of where it ended and what was found rotor by rotor, these "
    "set-points deliver the most by the exact wakes."
)
"""Reasons, by what the status does not say."""


def steer(
    problem: YawProblem, *, time_limit: float = 60.0, seed: int = 0, start: Floats | None = None
) -> Result[Floats]:
    """Find the misalignments at which the farm delivers the most.

    Parameters
    ----------
    problem
        The farm and its winds.
    time_limit
        Wall-clock limit [s]; the best set-points so far count.
    seed
        Ignored: nothing is drawn at random.
    start
        Misalignments [rad] from a neighbouring wind, shape ``(n,)``: where given, the search goes
        on from there and not over the rotors' whole ranges.

    Returns
    -------
    Misalignments [rad], shape ``(n,)``: LOCALLY_OPTIMAL where Ipopt converged to a point near them
    that is no better, OPTIMAL where they reach the bound.
    """
    begin = perf_counter()
    deadline = begin + time_limit
    best = Candidate(float(farm_power(problem, problem.facing)), problem.facing)
    status, reason = Status.FEASIBLE, ""
    bound, source = problem.bound, UNWAKED
    try:
        if best.power < (1 - GAP) * bound and perf_counter() < deadline:
            bound, source = closest_bound(problem)
        if best.power < (1 - GAP) * bound:
            best, status, reason = _searched(problem, best, start, deadline)
    except KeyboardInterrupt:
        status, reason = Status.INTERRUPTED, ""
    if best.power >= (1 - GAP) * bound:
        status, reason = Status.OPTIMAL, ""
    power = float(farm_power(problem, best.yaw))
    return Result(status, best.yaw, power, bound, perf_counter() - begin, source, reason)


class Candidate(NamedTuple):
    """Misalignments [rad], and the farm's power with them by the compiled exact wakes [W]."""

    power: float
    yaw: Floats


def judged(problem: YawProblem, yaw: Floats) -> Candidate:
    """Return misalignments with their exact power."""
    return Candidate(Sweep(problem, yaw).power, yaw)


def _searched(
    problem: YawProblem, best: Candidate, start: Floats | None, deadline: float
) -> tuple[Candidate, Status, str]:
    ends: list[Result[Floats]] = []
    try:
        for yaw, options in _starts(problem, start, deadline):
            best = max(best, judged(problem, yaw), key=_power)
            ends.append(climbed(problem, yaw, options, deadline))
            best = max(best, judged(problem, ends[-1].found()), key=_power)
            if ends[-1].status is Status.INTERRUPTED or perf_counter() >= deadline:
                break
        else:
            sweep = Sweep(problem, best.yaw)
            refine(sweep, around=FINE, passes=(4, 4), deadline=deadline)
            best = Candidate(sweep.power, sweep.yaw)
    except KeyboardInterrupt:
        return best, Status.INTERRUPTED, ""
    return best, *verdict(best.yaw, ends)


def verdict(yaw: Floats, ends: Sequence[Result[Floats]]) -> tuple[Status, str]:
    """Say how sure misalignments [rad] are that deliver no less than where Ipopt ended."""
    if any(end.status is Status.INTERRUPTED for end in ends):
        return Status.INTERRUPTED, ""
    converged = [end.found() for end in ends if end.status is Status.LOCALLY_OPTIMAL]
    if any(np.abs(yaw - end).max() <= FINE for end in converged):
        return Status.LOCALLY_OPTIMAL, NEARBY
    return Status.FEASIBLE, FAR if converged else NOT_CONVERGED.format(ends[-1].reason)


def _starts(
    problem: YawProblem, start: Floats | None, deadline: float
) -> Iterator[tuple[Floats, Mapping[str, float]]]:
    if start is not None:
        yield np.clip(start, problem.lower, problem.upper), FROM_NEARBY
        return
    yield refine(Sweep(problem, problem.facing), deadline=deadline), FROM_NEARBY
    if len(problem) * len(problem.wind_speeds) <= SMALL:
        for side in 1, -1:
            aside = np.full(len(problem), side * ASIDE)
            yield np.clip(aside, problem.lower, problem.upper), FROM_AFAR


def climbed(
    problem: YawProblem, yaw: Floats, options: Mapping[str, float], deadline: float
) -> Result[Floats]:
    """Climb from misalignments [rad] to a local optimum of the lifted program.

    Returns
    -------
    Misalignments within their bounds, wherever Ipopt ended.
    """
    farm, bounds = in_wind([problem]), (problem.lower, problem.upper)
    with uninterrupted():
        start = wakes(farm, yaw[None], bounds)
        lift = lifted.farm_yaw(farm, start, bounds=bounds, cap=problem.farm_cap)
        left = deadline - perf_counter()
        program = prepared(lift.program, time_limit=left, options=options)
    ended = search(program, lift.start)
    return ended.carrying(np.clip(ended.found()[lift.gamma[0]], *bounds))


def _power(candidate: Candidate) -> float:
    return candidate.power


def in_wind(problems: Sequence[YawProblem]) -> FarmInWind:
    """Return a farm as the program takes it: one problem a step, all winds of it within."""
    first = problems[0]
    curves = tuple(
        Curve(c.wind_speeds, c.powers, c.thrust_coefficients, c.yaw_exponent, c.air_density)
        for c in first.curves
    )
    speeds, directions, weights = (
        np.concatenate([getattr(problem, name) for problem in problems])
        for name in ("wind_speeds", "wind_directions", "weights")
    )
    lengths = [len(problem.wind_speeds) for problem in problems]
    return FarmInWind(
        turbines=first.turbines,
        D=first.rotor_diameters,
        H=first.hub_heights,
        curves=curves,
        curve_of=first.curve_of,
        speeds=speeds,
        directions=directions,
        weights=weights / len(problems),
        steps=np.repeat(np.arange(len(problems)), lengths),
        turbulence=first.turbulence,
        air_density=first.air_density,
        shear=first.shear,
        reference_height=first.reference_height,
    )
