"""FLORIS as the judge of set-points, and its own searches as methods to beat."""

from collections.abc import Sequence

import numpy as np
from floris import FlorisModel, UncertainFlorisModel
from floris.optimization.yaw_optimization.yaw_optimizer_scipy import YawOptimizationScipy
from floris.optimization.yaw_optimization.yaw_optimizer_sr import YawOptimizationSR
from numpy.typing import NDArray
from pandas import DataFrame

from windopt.domain.yaw_problem import YawProblem

Floats = NDArray[np.float64]


def serial_refine(problems: Sequence[YawProblem]) -> Floats:
    """Return FLORIS's misalignments [rad], shape ``(T, n)``, all problems side by side.

    ``YawOptimizationSR`` runs with its defaults, within the bounds of the first problem.
    """
    search = YawOptimizationSR(_searched(problems), **_bounds(problems))
    return _misalignments(search.optimize(print_progress=False))


def slsqp(problems: Sequence[YawProblem]) -> Floats:
    """Return FLORIS's misalignments [rad], shape ``(T, n)``, one problem after the other.

    ``YawOptimizationScipy`` runs with its defaults, within the bounds of the first problem.
    """
    search = YawOptimizationScipy(_searched(problems), **_bounds(problems))
    return _misalignments(search.optimize())


def _searched(problems: Sequence[YawProblem]) -> FlorisModel | UncertainFlorisModel:
    return _uncertain(problems[0]) if len(problems[0].weights) > 1 else _model(problems)


def _bounds(problems: Sequence[YawProblem]) -> dict[str, Floats]:
    return {
        "minimum_yaw_angle": np.degrees(problems[0].lower),
        "maximum_yaw_angle": np.degrees(problems[0].upper),
    }


def _misalignments(found: DataFrame) -> Floats:
    yaw: Floats = np.radians(np.vstack(found.yaw_angles_opt))
    return yaw


def farm_powers(problems: Sequence[YawProblem], yaw: Floats) -> Floats:
    """Return each problem's mean power by FLORIS [W], for misalignments ``(T, n)``."""
    model = _model(problems)
    winds = [len(problem.weights) for problem in problems]
    model.set(yaw_angles=np.degrees(np.repeat(yaw, winds, axis=0)))
    model.run()
    powers = np.split(model.get_farm_power(), np.cumsum(winds)[:-1])
    return np.array([p @ problem.weights for p, problem in zip(powers, problems, strict=True)])


def _settings(problem: YawProblem) -> dict[str, object]:
    """Return FLORIS's defaults for the ``gauss`` wake, without the curl's additions."""
    settings = FlorisModel.get_defaults()
    for part in "secondary_steering", "yaw_added_recovery", "transverse_velocities":
        settings["wake"][f"enable_{part}"] = False
    x, y = problem.turbines.T
    settings["farm"] |= {"layout_x": list(x), "layout_y": list(y), "turbine_type": ["nrel_5MW"]}
    result: dict[str, object] = settings
    return result


def _model(problems: Sequence[YawProblem]) -> FlorisModel:
    model = FlorisModel(_settings(problems[0]))
    directions = np.concatenate([problem.wind_directions for problem in problems])
    model.set(
        wind_directions=np.degrees(directions),
        wind_speeds=np.concatenate([problem.wind_speeds for problem in problems]),
        turbulence_intensities=np.full(len(directions), problems[0].turbulence),
    )
    return model


def _uncertain(problem: YawProblem) -> UncertainFlorisModel:
    """Return FLORIS's model of a scatter of directions; its sample points are the problem's."""
    directions = np.degrees(problem.wind_directions)
    middle = len(directions) // 2
    model = UncertainFlorisModel(
        _settings(problem),
        wd_std=float(directions[-1] - directions[middle]) / 2,
        wd_sample_points=[float(d) for d in directions - directions[middle]],
    )
    model.set(
        wind_directions=directions[[middle]],
        wind_speeds=problem.wind_speeds[[middle]],
        turbulence_intensities=np.array([problem.turbulence]),
    )
    return model
