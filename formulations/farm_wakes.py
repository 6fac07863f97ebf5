"""The wakes of a farm at given misalignments: who stands in whose wake, and what every rotor feels.

The program of :mod:`formulations.farm_yaw` needs three things beforehand, and here they are found:
the pairs of turbines with a wake between them, the source that disturbs each turbine's inflow most,
and a point at which the program's rows hold, to start from.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from formulations.farm_in_wind import FarmInWind
from formulations.lifted_rows import EPSILON, squares
from formulations.wake import K_A, K_B, SIGMA_0, added_turbulence, axial_induction

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

CLOSE = 0.1
"""Nearer than this a turbine is not downstream of another [m]."""

NEGLIGIBLE = 1e-4
"""Deficits below this, whatever the yaw, are left out."""

SIGMAS, MOVED = 4.0, 1.1
"""How many widths of a wake count, and how far aside it is moved at most [diameters]."""

IN_WAKE = 0.05
"""By how much a point's wind must be slowed to count as in a wake [m/s]."""

REACH, SIDE = 15.0, 2.0
"""How far downstream and sideways turbulence is added [diameters]."""


@dataclass(frozen=True, eq=False)
class Wakes:
    """The wakes of a farm at given misalignments.

    Parameters
    ----------
    gamma
        The misalignments [rad], shape ``(T, n)``.
    source, target, wind
        The pairs with a wake between them, shape ``(E,)``.
    place
        Where each target stands behind its source, the parameters of
        :func:`formulations.lifted_rows.squares`.
    main
        The source that disturbs a turbine most, or -1, shape ``(K, n)``.
    kappa
        How much it does: κ of equation (5) of :mod:`formulations.wake`, shape ``(K, n)``.
    C_T, I, U
        Thrust coefficients, turbulence and mean wind [wind speeds] of all turbines, ``(K, n)``.
    W
        Deficits at their points, shape ``(P, K, n)``.
    powers
        Of all turbines [W], shape ``(K, n)``.
    """

    gamma: Floats
    source: Places
    target: Places
    wind: Places
    place: Floats
    main: Places
    kappa: Floats
    C_T: Floats
    I: Floats  # noqa: E741
    U: Floats
    W: Floats
    powers: Floats


def wakes(farm: FarmInWind, gamma: Floats, bounds: tuple[Floats, Floats]) -> Wakes:
    """Return the wakes of the turbines, as the smooth model has them.

    Parameters
    ----------
    farm
        The farm and its winds.
    gamma
        Misalignments [rad], shape ``(T, n)``.
    bounds
        Lower and upper bounds of the misalignments [rad], of shape ``(n,)`` or ``(T, n)``: no wake
        that they let come near is left out.
    """
    pairs = _candidates(farm)
    felt = _felt(farm, gamma, pairs)
    j, k = pairs.source, pairs.wind
    strongest = np.zeros(len(j))
    low, high = (np.broadcast_to(bound, gamma.shape)[farm.steps] for bound in bounds)
    for yaw in low, np.clip(0.0, low, high), high:
        v = np.array([yaw[k, j], felt.C_T[k, j], felt.I[k, j]])
        strongest = np.maximum(strongest, _squares(v, pairs.place).max(axis=0, initial=0.0))
    kept = strongest > NEGLIGIBLE**2
    source, target, wind = pairs.source[kept], pairs.target[kept], pairs.wind[kept]
    powers = farm.powers(felt.U, gamma[farm.steps])
    return Wakes(gamma, source, target, wind, pairs.place[:, kept], *felt, powers)


class _Pairs(NamedTuple):
    source: Places
    target: Places
    wind: Places
    place: Floats


class _Felt(NamedTuple):
    main: Places
    kappa: Floats
    C_T: Floats
    I: Floats  # noqa: E741
    U: Floats
    W: Floats


def _candidates(farm: FarmInWind) -> _Pairs:
    """Return all pairs that might come into each other's wakes, and where they stand."""
    east, north = (farm.turbines - farm.turbines.mean(axis=0)).T
    theta = farm.directions[:, None] - 1.5 * np.pi
    x = east * np.cos(theta) - north * np.sin(theta)
    y = east * np.sin(theta) + north * np.cos(theta)
    dx = x[:, None, :] - x[:, :, None]  # (K, source, target)
    dy = y[:, None, :] - y[:, :, None]
    D = farm.D[None, :, None]
    near = np.abs(dy) < SIGMAS * (SIGMA_0 * D + _growth(farm) * dx) + MOVED * D + 0.25 * farm.D
    at = wind, source, target = np.nonzero((dx > CLOSE) & near)
    D_j = farm.D[source]
    side = 0.25 * farm.D[target] / D_j
    dz = (farm.H[target] - farm.H[source]) / D_j + 4 * farm.rows[:, None] * side
    return _Pairs(source, target, wind, np.array([dx[at] / D_j, dy[at] / D_j, side, *dz]))


def _growth(farm: FarmInWind) -> float:
    """Return by how much the roughest wake grows per distance, two diameters behind a rotor."""
    added = added_turbulence(2.0, farm.turbulence, 1.0) * 0.5**0.8
    return K_A * float(np.hypot(farm.turbulence, added)) + K_B


def _felt(farm: FarmInWind, gamma: Floats, pairs: _Pairs) -> _Felt:
    """Pass the winds from turbine to turbine, those first that stand in the fewest wakes."""
    K, n = len(farm.speeds), len(farm.turbines)
    yaw, shares = gamma[farm.steps].ravel(), farm.shares()[:, None]
    source, target = pairs.wind * n + pairs.source, pairs.wind * n + pairs.target
    sums, added, kappa = np.zeros((len(shares), K * n)), np.zeros(K * n), np.zeros(K * n)
    main = np.full(K * n, -1)
    most = added_turbulence(pairs.place[0], farm.turbulence, 1.0)

    def state() -> tuple[Floats, Floats, Floats, Floats]:
        W = (np.sqrt(EPSILON**2 + sums) - EPSILON).reshape(-1, K, n)
        U = np.cbrt((shares * (1 - W) ** 3).sum(axis=0))
        C_T = farm.thrusts(U) * np.cos(yaw.reshape(K, n))
        return C_T, np.sqrt(farm.turbulence**2 + added.reshape(K, n) ** 2), U, W

    for e in _by_depth(source, target, K * n):
        C_T, I, _, _ = (a.ravel() for a in state())  # noqa: E741
        v = np.array([yaw[source[e]], C_T[source[e]], I[source[e]]])
        d2 = _squares(v, pairs.place[:, e])
        sums += [np.bincount(target[e], row, K * n) for row in d2]
        kappas = most[e] * _overlap(farm, d2, pairs.place[:, e], pairs.wind[e])
        a = np.asarray(axial_induction(ca.DM(v[0]), ca.DM(v[1]))).ravel()
        raised = kappas * a**0.8
        for p in np.argsort(raised, kind="stable"):  # the strongest comes last
            i = target[e[p]]
            if raised[p] > added[i]:
                added[i], kappa[i], main[i] = raised[p], kappas[p], pairs.source[e[p]]
    return _Felt(main.reshape(K, n), kappa.reshape(K, n), *state())


def _by_depth(source: Places, target: Places, cells: int) -> Iterator[Places]:
    """Yield the pairs whose sources stand in as many wakes, one behind the other."""
    depth, deeper = np.zeros(cells, dtype=int), np.zeros(cells, dtype=int)
    while True:
        np.maximum.at(deeper, target, depth[source] + 1)
        if (deeper == depth).all():
            break
        depth[:] = deeper
    of_pairs = depth[source]
    for d in range(of_pairs.max(initial=-1) + 1):
        yield np.flatnonzero(of_pairs == d)


def _squares(v: Floats, place: Floats) -> Floats:
    rows = len(place) - 3
    if not place.shape[1]:
        return np.zeros((3 * rows, 0))
    return np.asarray(squares(rows).map(place.shape[1])(v, place))


def _overlap(farm: FarmInWind, d2: Floats, place: Floats, wind: Places) -> Floats:
    """Return the share of a rotor's points that a wake slows noticeably."""
    counts = np.repeat([1, 2] if len(d2) == 6 else [1, 1, 1], 3) / 9
    slowed = np.sqrt(d2) * farm.speeds[wind] > IN_WAKE
    dx, dy, side = place[:3]
    within = np.mean([np.abs(dy + s * side) < SIDE for s in (-1, 0, 1)], axis=0) * (dx <= REACH)
    share: Floats = (counts @ slowed) * within
    return share
