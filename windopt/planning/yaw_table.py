"""Yaw tables: one wind-steering problem for each direction and speed, side by side.

Directions are solved apart from each other, on as many processors as there are, and each speed from
the answer of the speed before it. Then every cell tries the misalignments of its neighbours in
direction and in speed and keeps the best, until none improves: the answer of a luckier neighbour
leads out of a local optimum. What each cell delivers is judged by the exact model.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import inf, pi
from time import perf_counter, time
from typing import Any

import numpy as np
from joblib import Parallel, delayed
from numpy.typing import ArrayLike, NDArray

from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.domain.steering import Steering, yaw_problem
from windopt.domain.turbine import require_not_negative, require_positive
from windopt.domain.wind import Wind
from windopt.domain.yaw_problem import GAP, YawProblem
from windopt.domain.yaw_table import YawTable
from windopt.errors import InvalidInput, require_kind
from windopt.planning.yaw import DEFAULT_METHOD, closely_bounded, curve_of, method_named
from windopt.result import Result, Status
from windopt.solving.farm_yaw import steer
from windopt.solving.yaw_bound import UNWAKED
from windopt.wakes.farm import farm_power

Floats = NDArray[np.float64]
Done = Callable[[int, int], None]

LARGEST = 1_000_000  # cells


@dataclass(frozen=True)
class TableOptions:
    """How a table is solved.

    Parameters
    ----------
    jobs
        Processors at work; -1 for all. Inside ``joblib.parallel_config(backend="dask")`` the cells
        go to a cluster.
    time_limit
        Wall-clock limit of the table [s]; cells not solved by then have their rotors face the wind,
        or take a neighbour's misalignments.
    seed
        Of whatever is drawn at random.
    """

    jobs: int = 1
    time_limit: float = inf
    seed: int = 0

    def __post_init__(self) -> None:
        require_not_negative("time_limit", self.time_limit)
        if self.jobs == 0:
            raise InvalidInput("jobs", "to be -1 or a number of processors", self.jobs)


def plan_yaw_table(
    farm: Farm,
    speeds: ArrayLike,
    directions: ArrayLike,
    *,
    method: str = DEFAULT_METHOD,
    steering: Steering | None = None,
    air_density: float = STANDARD_AIR_DENSITY,
    options: TableOptions | None = None,
    done: Done | None = None,
) -> Result[YawTable]:
    """Tabulate the misalignments with which a farm delivers the most power.

    Parameters
    ----------
    farm
        The wind farm.
    speeds
        Wind speeds [m/s], increasing.
    directions
        Where the wind blows from, clockwise from north [rad], increasing within one turn.
    method, steering, air_density
        As in :func:`windopt.plan_yaw`; with a scatter of directions the table is robust to it.
    options
        Processors, time limit and seed.
    done
        Called with the number of cells solved and of all cells.

    Returns
    -------
    Result
        Its objective and bound are means over the cells [W].

    Raises
    ------
    InvalidInput
        If the farm is not one, speeds or directions do not increase within their range, there are
        too many cells, an option cannot be used, or a turbine names an unknown power coefficient.
    """
    require_kind("farm", farm, Farm)
    begin = perf_counter()
    options, steering = options or TableOptions(), steering or Steering()
    method_named(method)
    require_positive("air_density", air_density)
    v, theta = _axis("speeds", speeds, 0.0, 1e3), _axis("directions", directions, 0.0, 2 * pi)
    if len(v) * len(theta) > LARGEST:
        raise InvalidInput("yaw table", f"of at most {LARGEST} cells", len(v) * len(theta))
    winds = [Wind.from_met(speed, np.degrees(direction)) for direction in theta for speed in v]
    problems = [yaw_problem(farm, w, steering, curve_of, air_density=air_density) for w in winds]
    found: list[Result[NDArray[np.float64]]] = []
    for row in _solved(problems, len(v), method, options):
        found += row
        if done is not None:
            done(len(found), len(problems))
    shape = len(theta), len(v)
    yaw = np.array([_angles(p, r) for p, r in zip(problems, found, strict=True)])
    power = np.array([float(farm_power(p, y)) for p, y in zip(problems, yaw, strict=True)])
    statuses = {r.status for r in found}
    if method != "algorithm-1" and _share(problems, yaw, power, shape):
        statuses.add(Status.FEASIBLE)  # nothing is known of a neighbour's answer in this wind
    bound = np.array([_bound(p, r, at) for p, r, at in zip(problems, found, power, strict=True)])
    baseline = [float(farm_power(p, np.zeros(len(farm)))) for p in problems]
    table = YawTable(
        farm,
        theta,
        v,
        yaw.reshape(*shape, len(farm)),
        power.reshape(shape),
        np.reshape(baseline, shape),
        bound.reshape(shape),
        steering,
        air_density,
    )
    status = _status(statuses, optimal=bool((bound - power <= GAP * bound).all()))
    closer = (r.bound_source for p, r, b in zip(problems, found, bound, strict=True) if b < p.bound)
    objective, proved, source = float(power.mean()), float(bound.mean()), next(closer, UNWAKED)
    return Result(status, table, objective, proved, perf_counter() - begin, source)


def _axis(field: str, values: ArrayLike, low: float, high: float) -> Floats:
    axis = np.atleast_1d(np.asarray(values, dtype=float))
    within = np.isfinite(axis).all() and (axis >= low).all() and (axis < high).all()
    if axis.ndim != 1 or not axis.size or not within or (np.diff(axis) <= 0).any():
        raise InvalidInput(field, f"to increase from {low:g} to below {high:g}", axis)
    return axis


def _solved(
    problems: list[YawProblem], V: int, method: str, options: TableOptions
) -> Iterator[list[Result[NDArray[np.float64]]]]:
    """Yield the answers of each direction, in order: one for each of its V speeds."""
    deadline = time() + options.time_limit  # the clock that processes share
    stopped = False

    def tasks() -> Iterator[Any]:
        for first in range(0, len(problems), V):
            until = -inf if stopped else deadline
            yield delayed(_row)(problems[first : first + V], method, until, options.seed)

    for row in Parallel(n_jobs=options.jobs, return_as="generator")(tasks()):
        stopped = stopped or any(result.status is Status.INTERRUPTED for result in row)
        yield row


def _row(
    problems: list[YawProblem], method: str, deadline: float, seed: int
) -> list[Result[NDArray[np.float64]]]:
    """Solve one direction speed by speed; the program goes on from the answer of the last speed."""
    found: list[Result[NDArray[np.float64]]] = []
    for problem in problems:
        left = deadline - time()
        if left <= 0 or (found and found[-1].status is Status.INTERRUPTED):
            found.append(Result(Status.NO_SOLUTION, None, -inf, problem.bound, 0.0))
        elif method == "nlp" and found:
            start = found[-1].solution
            found.append(steer(problem, time_limit=left, seed=seed, start=start))
        else:
            result = method_named(method)(problem, time_limit=left, seed=seed)
            found.append(closely_bounded(problem, result, time_limit=deadline - time()))
    return found


def _angles(problem: YawProblem, result: Result[NDArray[np.float64]]) -> Floats:
    """Return what was found, or facing the wind where nothing was."""
    return problem.facing if result.solution is None else result.solution


def _share(problems: list[YawProblem], yaw: Floats, power: Floats, shape: tuple[int, int]) -> bool:
    """Let every cell try its neighbours' misalignments, in place, until none improves.

    Returns
    -------
    Whether any did.
    """
    stale, shared = set(range(len(problems))), False
    while stale:
        improved = set()
        for cell in sorted(stale):
            around = _neighbours(cell, shape)
            tried = np.array([problems[cell].facing, *(yaw[other] for other in around)])
            powers = farm_power(problems[cell], tried)
            best = int(powers.argmax())
            if powers[best] > power[cell] * (1 + GAP):
                yaw[cell], power[cell], shared = tried[best], powers[best], True
                improved.update(around)
        stale = improved
    return shared


def _neighbours(cell: int, shape: tuple[int, int]) -> list[int]:
    """Return the cells next to ``cell``; directions close a circle."""
    D, V = shape
    d, v = divmod(cell, V)
    directions = {(d - 1) % D, (d + 1) % D} - {d}
    speeds = {v - 1, v + 1} & set(range(V))
    return sorted([i * V + v for i in directions] + [d * V + j for j in speeds])


def _bound(problem: YawProblem, result: Result[NDArray[np.float64]], power: float) -> float:
    return min(problem.bound, result.bound) if result.bound >= power else problem.bound


def _status(statuses: set[Status], *, optimal: bool) -> Status:
    if Status.INTERRUPTED in statuses:
        return Status.INTERRUPTED
    if optimal:
        return Status.OPTIMAL
    local = statuses <= {Status.OPTIMAL, Status.LOCALLY_OPTIMAL}
    return Status.LOCALLY_OPTIMAL if local else Status.FEASIBLE
