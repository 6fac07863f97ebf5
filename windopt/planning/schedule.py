"""A schedule of yaw: set-points for each step of a forecast, which nacelles can follow and should.

Each step is a wind-steering problem of its own, robust to the directions that the forecast holds
possible. Nacelles start where the step before left them: how far they turn in the time of a step
bounds the problem itself, and where the best set-points would not repay the trip, they stay. Where
they turn so slowly that one step hinders the next, the nonlinear program decides all steps at once.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf, pi
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.plan import YawPlan
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.domain.steering import Pace, Steering, yaw_problem
from windopt.domain.turbine import require_positive
from windopt.domain.wind import Wind, WindForecast
from windopt.domain.yaw_problem import YawProblem
from windopt.errors import require_kind
from windopt.planning.turbine_yaw import present_misalignments
from windopt.planning.yaw import curve_of, judged_plan, method_named
from windopt.result import Result, Status
from windopt.solving.yaw_schedule import Window, mean_power, steer_all
from windopt.wakes.farm import farm_power

Floats = NDArray[np.float64]

METHOD = "serial-refine"
"""What decides a step unless another method is asked for: robust to a forecast's spread, a step has
several winds, and the nonlinear program takes several times as long for little more power."""

SPREAD = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Levels whose directions stand for a forecast's spread, each a fifth of what may come."""


def plan_schedule(
    farm: Farm,
    forecast: WindForecast,
    *,
    nacelle: float | Sequence[float],
    method: str = METHOD,
    steering: Steering | None = None,
    pace: Pace | None = None,
    air_density: float = STANDARD_AIR_DENSITY,
    time_limit: float = 60.0,
    seed: int = 0,
) -> tuple[Result[YawPlan], ...]:
    """Set the rotors of a farm for each step of a forecast.

    Parameters
    ----------
    farm
        The wind farm.
    forecast
        The winds to come; where it has quantiles, their directions are what a step is robust to.
    nacelle
        Where the nacelles face at present, clockwise from north [rad]: one direction for all
        turbines, or one for each.
    method, steering, air_density
        As in :func:`windopt.plan_yaw`; ``"nlp"`` looks ahead where the pace hinders it, and turns
        nacelles before the wind in which they will stand aside.
    pace
        How nacelles turn; by default 0.3 deg/s at most, and only for a gain of 0.1 %.
    time_limit
        Wall-clock limit of all steps together [s]. Ctrl-C ends the search; steps left hold the
        nacelles or face the wind, whichever delivers more.
    seed
        Of whatever is drawn at random.

    Returns
    -------
    One result for each step, in order; its bound is the power of the farm without wakes.

    Raises
    ------
    InvalidInput
        If the farm or the forecast is not one, an option cannot be used, or a turbine names an
        unknown power coefficient.
    FailedCheck
        If the set-points of a step do not stand up to the independent checker.
    """
    require_kind("farm", farm, Farm)
    require_kind("forecast", forecast, WindForecast)
    deadline = perf_counter() + time_limit
    require_positive("air_density", air_density)
    pace, steering = pace or Pace(), steering or Steering()
    search = method_named(method)
    exposed = [_exposed(steering, forecast, step) for step in range(len(forecast))]
    problems = [
        yaw_problem(
            farm, wind, e, curve_of, air_density=air_density, present=_present(farm, wind, nacelle)
        )
        for wind, e in zip(forecast.winds, exposed, strict=True)
    ]
    turns = pace.rate * _seconds(forecast)
    ahead = None
    if method == "nlp":
        ahead = _ahead(problems, float(turns.min()), pace.threshold, deadline)
    results: list[Result[YawPlan]] = []
    for step, wind in enumerate(forecast.winds):
        begin = perf_counter()
        present = _present(farm, wind, nacelle)
        problem = replace(problems[step], present=present)
        reached = _within_reach(problem, present, float(turns[step]))
        if ahead is not None:
            found = ahead.carrying(np.clip(ahead.found()[step], reached.lower, reached.upper))
        else:
            left = 0.0 if stopped(results) else max(0.0, deadline - begin)
            found = search(reached, time_limit=left / (len(forecast) - step), seed=seed)
            if method != "algorithm-1":
                found = _worth_it(reached, present, found, pace.threshold)
        result = judged_plan(farm, wind, problem, exposed[step], _unproved(found, problem))
        shared = 0.0 if ahead is None else ahead.runtime / len(forecast)
        results.append(result.timed(shared + perf_counter() - begin))
        nacelle = [point.nacelle for point in result.found().set_points]
    return tuple(results)


def _present(farm: Farm, wind: Wind, nacelle: float | Sequence[float]) -> Floats:
    return np.array(present_misalignments(len(farm), wind, nacelle))


def _seconds(forecast: WindForecast) -> Floats:
    """Return how long nacelles have to turn before each step [s], shape ``(T,)``."""
    starts = np.concatenate([[forecast.issued], forecast.time[:-1]])
    seconds: Floats = (forecast.time - starts) / np.timedelta64(1, "s")
    return seconds


def _ahead(
    problems: Sequence[YawProblem], turn: float, threshold: float, deadline: float
) -> Result[Floats] | None:
    """Decide all steps at once, where turning by ``turn`` [rad] in one of them is not enough.

    The trips are weighed as a whole, for one that is made early may repay later only.

    Returns
    -------
    Misalignments [rad], shape ``(T, n)``; ``None`` where the steps are better taken one by one, as
    each can be reached from any other, or as the wind turns too fast to be followed.
    """
    window = Window(problems, turn)
    farthest = max(float((problem.upper - problem.lower).max()) for problem in problems)
    if turn >= farthest + np.abs(window.shifts).max(initial=0.0):
        return None
    found = steer_all(problems, turn=turn, time_limit=max(0.0, deadline - perf_counter()))
    if found.solution is None:
        return None
    held = window.nearest(np.array([problem.present for problem in problems]))
    kept = mean_power(problems, held)
    return found if found.objective > kept * (1 + threshold) else _instead(found, held, kept)


def _exposed(steering: Steering, forecast: WindForecast, step: int) -> Steering:
    """Return what the farm is steered under in one step: the directions the forecast spreads to.

    Its speeds are left at their mean: the best misalignments hardly depend on them below the rated
    power, and nothing is to be gained above.
    """
    if forecast.quantiles is None or steering.scenarios or steering.direction_std:
        return steering
    _, turns = forecast.quantiles.at(SPREAD)
    speed, theta = float(forecast.speed[step]), float(forecast.theta_met[step])
    winds = (Wind.from_met(speed, np.degrees(theta + turn)) for turn in turns[step].tolist())
    return replace(steering, scenarios=tuple((wind, 1 / len(SPREAD)) for wind in winds))


def _within_reach(problem: YawProblem, present: Floats, reach: float) -> YawProblem:
    """Bound the misalignments by how far [rad] nacelles turn from the present ones.

    Where the wind has left a nacelle so far behind that it cannot come within its bounds in time,
    the bound nearest to it stands.
    """
    if reach >= pi:
        return problem
    lower = np.clip(present - reach, problem.lower, problem.upper)
    upper = np.clip(present + reach, problem.lower, problem.upper)
    return problem.between(lower, upper)


def _worth_it(
    problem: YawProblem, present: Floats, found: Result[Floats], threshold: float
) -> Result[Floats]:
    """Hold the nacelles, or face the wind, where what was found delivers hardly more."""
    held = np.clip(present, problem.lower, problem.upper)
    kept, faced = (float(p) for p in farm_power(problem, np.array([held, problem.facing])))
    power = -inf if found.solution is None else float(farm_power(problem, found.solution))
    if max(power, faced) <= kept * (1 + threshold):
        return _instead(found, held, kept)
    return found if power >= faced else _instead(found, problem.facing, faced)


def _instead(found: Result[Floats], yaw: Floats, power: float) -> Result[Floats]:
    """Return other misalignments than those found, of which nothing is known to be optimal."""
    status = Status.INTERRUPTED if found.status is Status.INTERRUPTED else Status.FEASIBLE
    return replace(found, status=status, solution=yaw, objective=power, reason="")


def _unproved(found: Result[Floats], problem: YawProblem) -> Result[Floats]:
    """Forget what is proved within reach of the nacelles: it is no bound on the set-points."""
    local = found.status is Status.OPTIMAL
    status = Status.LOCALLY_OPTIMAL if local else found.status
    return replace(found, status=status, bound=problem.bound)


def stopped(results: Sequence[Result[YawPlan]]) -> bool:
    """Whether the user ended the search at one of these steps."""
    return any(result.status is Status.INTERRUPTED for result in results)
