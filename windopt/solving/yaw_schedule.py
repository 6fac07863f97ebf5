"""Wake steering step by step, with nacelles that turn only so fast.

All steps are decided at once by one lifted program, so that a nacelle starts to turn before the
wind in which it will stand aside. Clipping each step's own best set-points instead would lose what
the limit costs twice: turned too late, and turned in vain.
"""

from collections.abc import Sequence
from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from formulations import farm_yaw as lifted
from formulations.farm_wakes import wakes
from windopt.domain.yaw_problem import YawProblem
from windopt.errors import InvalidInput
from windopt.result import Result, Status
from windopt.solving.farm_yaw import FINE, FROM_NEARBY, in_wind, verdict
from windopt.solving.interrupts import uninterrupted
from windopt.solving.rotor_by_rotor import refine
from windopt.solving.separable import prepared, search
from windopt.solving.wake_sweep import Sweep
from windopt.solving.yaw_bound import UNWAKED, closest_bound
from windopt.wakes.farm import farm_power

Floats = NDArray[np.float64]


def steer_all(
    problems: Sequence[YawProblem], *, turn: float, time_limit: float = 60.0, seed: int = 0
) -> Result[Floats]:
    """Find the misalignments of all steps at which the farm delivers the most on average.

    Parameters
    ----------
    problems
        One for each step, of the same farm. If the first has ``present`` misalignments, they are
        those of the step before it, in the same wind.
    turn
        The most that a nacelle may turn from one step to the next [rad]. It turns with the weighted
        mean direction of the wind, less the change of its misalignment.
    time_limit
        Wall-clock limit [s]; the bound comes last, and closer where time is left for it.
    seed
        Ignored: nothing is drawn at random.

    Returns
    -------
    Misalignments [rad], shape ``(T, n)``; the objective is the mean power over the steps [W].

    Raises
    ------
    InvalidInput
        If there is no step, the steps are not of one farm, or ``turn`` is not positive.
    """
    begin = perf_counter()
    deadline = begin + time_limit
    _require(problems, turn)
    window = Window(problems, turn)
    if not window.open:
        reason = "A nacelle cannot follow the wind: its bounds and the limit exclude each other."
        return Result(Status.INFEASIBLE, None, -inf, -inf, perf_counter() - begin, "", reason)
    best = window.nearest(np.array([problem.facing for problem in problems]))
    status, reason, source = Status.FEASIBLE, "", UNWAKED
    bounds = [problem.bound for problem in problems]
    try:
        if perf_counter() < deadline:
            best, status, reason = _searched(problems, window, best, deadline)
        for t, problem in enumerate(problems):
            if perf_counter() < deadline and status is not Status.INTERRUPTED:
                closest, told = closest_bound(problem)
                if closest < bounds[t]:
                    bounds[t], source = closest, told
    except KeyboardInterrupt:
        status, reason = Status.INTERRUPTED, ""
    power, runtime = mean_power(problems, best), perf_counter() - begin
    return Result(status, best, power, float(np.mean(bounds)), runtime, source, reason)


def _searched(
    problems: Sequence[YawProblem], window: "Window", best: Floats, deadline: float
) -> tuple[Floats, Status, str]:
    def better(a: Floats, b: Floats) -> Floats:
        return max(a, b, key=lambda yaw: mean_power(problems, yaw))

    alone = [refine(Sweep(p, p.facing), deadline=deadline) for p in problems]
    start = window.nearest(np.array(alone))
    best = better(best, start)
    if perf_counter() >= deadline:
        return best, Status.FEASIBLE, ""
    climb = _climbed(problems, window, start, deadline)
    best = better(best, window.nearest(climb.found()))
    if climb.status is not Status.INTERRUPTED:
        best = _refined(problems, window, best, deadline)
    return best, *verdict(best, [climb])


def mean_power(problems: Sequence[YawProblem], yaw: Floats) -> float:
    """Return the mean over the steps of the exact power [W]."""
    return float(np.mean([farm_power(p, y) for p, y in zip(problems, yaw, strict=True)]))


class Window:
    """The misalignments from which every later step can be reached, by bounds and turning limit."""

    def __init__(self, problems: Sequence[YawProblem], turn: float) -> None:
        self.turn = turn
        theta = np.unwrap([_mean_direction(problem) for problem in problems])
        self.shifts = np.diff(theta)  # a nacelle at rest changes its misalignment by as much
        self.lower = np.array([problem.lower for problem in problems])
        self.upper = np.array([problem.upper for problem in problems])
        if (present := problems[0].present) is not None:
            self.lower[0] = np.maximum(self.lower[0], present - turn)
            self.upper[0] = np.minimum(self.upper[0], present + turn)
        for t in range(len(problems) - 2, -1, -1):
            low, high = self.lower[t + 1] - turn, self.upper[t + 1] + turn
            self.lower[t] = np.maximum(self.lower[t], low - self.shifts[t])
            self.upper[t] = np.minimum(self.upper[t], high - self.shifts[t])

    @property
    def open(self) -> bool:
        """Whether there are any."""
        return bool((self.lower <= self.upper).all())

    def nearest(self, wanted: Floats) -> Floats:
        """Return the nearest that can be kept step after step, shape ``(T, n)``."""
        yaw = np.clip(wanted, self.lower, self.upper)
        for t, shift in enumerate(self.shifts, start=1):
            moved = yaw[t - 1] + shift
            reach = np.clip(yaw[t], moved - self.turn, moved + self.turn)
            yaw[t] = np.clip(reach, self.lower[t], self.upper[t])
        return yaw

    def around(self, yaw: Floats, t: int) -> tuple[Floats, Floats]:
        """Return the bounds of one step while the others stay."""
        lower, upper = self.lower[t], self.upper[t]
        beside = [yaw[t - 1] + self.shifts[t - 1]] if t else []
        if t < len(yaw) - 1:
            beside.append(yaw[t + 1] - self.shifts[t])
        for at in beside:
            lower, upper = np.maximum(lower, at - self.turn), np.minimum(upper, at + self.turn)
        return np.minimum(lower, yaw[t]), np.maximum(upper, yaw[t])


def _mean_direction(problem: YawProblem) -> float:
    theta, w = problem.wind_directions, problem.weights
    return float(np.arctan2(w @ np.sin(theta), w @ np.cos(theta)))


def _climbed(
    problems: Sequence[YawProblem], window: Window, start: Floats, deadline: float
) -> Result[Floats]:
    farm, bounds = in_wind(problems), (window.lower, window.upper)
    turns, cap = lifted.Turns(window.turn, window.shifts), problems[0].farm_cap
    with uninterrupted():
        found = wakes(farm, start, bounds)
        lift = lifted.farm_yaw(farm, found, bounds=bounds, cap=cap, turns=turns)
        left = deadline - perf_counter()
        program = prepared(lift.program, time_limit=left, options=FROM_NEARBY)
    ended = search(program, lift.start)
    return ended.carrying(ended.found()[lift.gamma])


def _refined(
    problems: Sequence[YawProblem], window: Window, yaw: Floats, deadline: float
) -> Floats:
    """Turn rotor after rotor in step after step as far as the steps beside it let it."""
    yaw = yaw.copy()
    for t, problem in enumerate(problems):
        sweep = Sweep(problem.between(*window.around(yaw, t)), yaw[t])
        yaw[t] = refine(sweep, around=FINE, passes=(4,), deadline=deadline)
    return yaw


def _require(problems: Sequence[YawProblem], turn: float) -> None:
    if not problems:
        raise InvalidInput("problems", "to be one step at least", 0)
    if not turn > 0:
        raise InvalidInput("turn", "> 0 rad", turn)
    first = problems[0]
    for problem in problems[1:]:
        same = problem.turbines.shape == first.turbines.shape and problem.curves == first.curves
        if not (same and (problem.turbines == first.turbines).all()):
            raise InvalidInput("problems", "of the same farm", "another farm")
