"""The wind and power of every turbine of a farm: the exact twin of FLORIS's ``gauss`` model.

Turbines are taken from upstream to downstream, each adding its wake to those behind it; deficits
are fractions of the free wind and combine by the root of the sum of their squares (``sosfs``). A
rotor feels the wind at 3 by 3 points and averages it cubically. FLORIS's default input switches
three parts of its curl model on that are left out here (``enable_secondary_steering``,
``enable_yaw_added_recovery`` and ``enable_transverse_velocities``): with them set to false, the two
agree to 1e-9 of the farm's power.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from windopt.domain.yaw_problem import ROTOR_POINTS, YawProblem
from windopt.errors import InvalidInput
from windopt.wakes.gaussian import Rotor, added_turbulence, deficit

Floats = NDArray[np.float64]

IN_WAKE = 0.05  # m/s by which a point must be slowed to count as in the wake
REACH = 15.0  # diameters downstream as far as turbulence is added
BATCH = 4_000  # turbines times winds times misalignments at once, so that arrays stay in the cache


@dataclass(frozen=True, eq=False)
class Flow:
    """What the turbines feel and deliver, each of shape ``(..., S, n)``.

    Parameters
    ----------
    speeds
        Cubic mean of the wind over each rotor [m/s], not corrected for yaw.
    powers
        Of each turbine [W], before any curtailment by the farm's cap.
    turbulence
        Intensity at each rotor [-].
    thrust
        Coefficients, their loss by yaw included [-].
    """

    speeds: Floats
    powers: Floats
    turbulence: Floats
    thrust: Floats


def turbine_powers(problem: YawProblem, yaw: Floats) -> Floats:
    """Return what each turbine delivers [W].

    Parameters
    ----------
    problem
        The farm and its winds.
    yaw
        Misalignments [rad], shape ``(..., n)``: as many sets of them at once as one likes.

    Returns
    -------
    Shape ``(..., S, n)``.
    """
    return flow(problem, yaw).powers


def farm_power(problem: YawProblem, yaw: Floats) -> Floats:
    """Return the objective [W], shape ``(...)``: the weighted mean power within the farm's cap."""
    total = turbine_powers(problem, yaw).sum(axis=-1)
    mean: Floats = np.minimum(total, problem.farm_cap) @ problem.weights
    return mean


def flow(problem: YawProblem, yaw: Floats) -> Flow:
    """Return the wind, power, turbulence and thrust of each turbine.

    Parameters
    ----------
    problem
        The farm and its winds.
    yaw
        Misalignments [rad], shape ``(..., n)``.
    """
    n, S = len(problem), len(problem.wind_speeds)
    gamma = np.asarray(yaw, dtype=float)
    if gamma.shape[-1:] != (n,):
        raise InvalidInput("yaw", f"of shape (..., {n})", gamma.shape)
    rows = gamma.reshape(-1, n)
    step = max(1, BATCH // (n * S))
    parts = [_flow(problem, rows[b : b + step]) for b in range(0, len(rows), step)]
    shape = (*gamma.shape[:-1], S, n)
    fields = zip(*parts, strict=True) if parts else [np.zeros((1, 0, S, n))] * 4
    speeds, powers, turbulence, thrust = (np.concatenate(f).reshape(shape) for f in fields)
    return Flow(speeds, powers, turbulence, thrust)


@dataclass(frozen=True, eq=False)
class _Sorted:
    """A farm in its winds, from upstream to downstream; shapes start with ``(S, n)``."""

    order: NDArray[np.intp]
    x: Floats
    y: Floats
    D: Floats
    H: Floats
    kind: NDArray[np.intp]
    u0: Floats  # free wind at the rows of points (S, n, 3)


@lru_cache(maxsize=8)
def _sorted(problem: YawProblem) -> _Sorted:
    """Turn the farm so that the wind blows along x, and sort it along the wind."""
    east, north = (problem.turbines - problem.turbines.mean(axis=0)).T
    theta = problem.wind_directions[:, None] - 1.5 * np.pi
    x = east * np.cos(theta) - north * np.sin(theta)
    y = east * np.sin(theta) + north * np.cos(theta)
    order = x.argsort(axis=1, kind="stable")
    D, H = problem.rotor_diameters[order], problem.hub_heights[order]
    heights = H[..., None] + D[..., None] * ROTOR_POINTS
    u0 = problem.wind_speeds[:, None, None] * (heights / problem.reference_height) ** problem.shear
    x, y = (np.take_along_axis(a, order, axis=1) for a in (x, y))
    return _Sorted(order, x, y, D, H, problem.curve_of[order], u0)


def _flow(problem: YawProblem, gamma: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Return speeds, powers, turbulence and thrust of ``gamma`` ``(B, n)``."""
    farm = _sorted(problem)
    (S, n), B = farm.order.shape, len(gamma)
    gamma = gamma[:, farm.order]
    slowed = np.zeros((B, S, n, 3, 3))  # squares of the deficits [m2/s2]
    turbulence = np.full((B, S, n, 3), problem.turbulence)
    speeds, thrust = np.empty((B, S, n)), np.empty((B, S, n))
    for i in range(n):
        u = farm.u0[:, i, None, :] - np.sqrt(slowed[:, :, i])
        speeds[..., i] = np.cbrt((u**3).mean(axis=(-1, -2)))
        thrust[..., i] = _thrust(problem, speeds[..., i], farm.kind[:, i]) * np.cos(gamma[..., i])
        if i < n - 1:
            _add_wake(problem, farm, i, gamma, thrust, slowed, turbulence)
    powers = _powers(problem, speeds, gamma, farm.kind)
    back = farm.order.argsort(axis=1)[None]
    sorted_fields = speeds, powers, turbulence.mean(axis=-1), thrust
    speeds, powers, turbulence, thrust = (np.take_along_axis(f, back, 2) for f in sorted_fields)
    return speeds, powers, turbulence, thrust


def _add_wake(
    problem: YawProblem,
    farm: _Sorted,
    i: int,
    gamma: Floats,
    thrust: Floats,
    slowed: Floats,
    turbulence: Floats,
) -> None:
    """Add the wake of the i-th turbine from upstream to all behind it."""
    behind = slice(i + 1, None)
    own = turbulence[:, :, i, None]
    if (own == own[..., :1]).all():
        own = own[..., :1]
    D = farm.D[:, i, None, None]
    rotor = Rotor(D, gamma[:, :, i, None, None], thrust[:, :, i, None, None], own)
    dx = (farm.x[:, behind] - farm.x[:, i, None])[..., None]
    points = farm.D[:, behind, None] * ROTOR_POINTS
    dy = (farm.y[:, behind] - farm.y[:, i, None])[..., None] + points
    dz = (farm.H[:, behind] - farm.H[:, i, None])[..., None] + points
    loss = deficit(rotor, dx, dy, dz[:, :, None]) * farm.u0[:, behind, None]
    slowed[:, :, behind] += loss**2

    overlap = (loss > IN_WAKE).mean(axis=(-1, -2))[..., None]
    within = (np.abs(dy) < 2 * D) & (dx <= REACH * D)
    added = overlap * added_turbulence(rotor, problem.turbulence, dx) * within
    raised = np.sqrt(added**2 + problem.turbulence**2)
    np.maximum(turbulence[:, :, behind], raised, out=turbulence[:, :, behind])


def _thrust(problem: YawProblem, speeds: Floats, kind: NDArray[np.intp]) -> Floats:
    """Thrust coefficients facing the wind, by each turbine's own curve."""
    C_T = problem.curves[0].thrust(speeds)
    for k, curve in enumerate(problem.curves[1:], start=1):
        C_T = np.where(kind == k, curve.thrust(speeds), C_T)
    return C_T


def _powers(problem: YawProblem, speeds: Floats, gamma: Floats, kind: NDArray[np.intp]) -> Floats:
    powers = np.zeros_like(speeds)
    for k, curve in enumerate(problem.curves):
        density = (problem.air_density / curve.air_density) ** (1 / 3)
        v = density * speeds * np.cos(gamma) ** (curve.yaw_exponent / 3)
        powers = np.where(kind == k, curve.power(v), powers)
    return powers


@dataclass(frozen=True, eq=False)
class Yield:
    """What the turbines feel and deliver in the mean over the winds, each of shape ``(n,)``.

    Parameters
    ----------
    speeds
        Wind speed at each rotor [m/s].
    powers
        Of each turbine [W], curtailed in proportion wherever the farm's cap asks for it.
    """

    speeds: Floats
    powers: Floats


def expected_yield(problem: YawProblem, yaw: Floats) -> Yield:
    """Return the weighted mean over the winds of one set of misalignments [rad], shape ``(n,)``."""
    found = flow(problem, yaw)
    total = found.powers.sum(axis=1)
    kept = np.minimum(1.0, problem.farm_cap / np.maximum(total, 1e-300))
    weights = problem.weights
    return Yield(weights @ found.speeds, (weights * kept) @ found.powers)
