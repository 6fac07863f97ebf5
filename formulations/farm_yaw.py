r"""Farm-wide yaw: turn some rotors aside so that their wakes miss the others.

:math:`\gamma_{it}` is the misalignment of turbine i in step t. In each wind k of the step it feels
the wind :math:`u_k U_{ik}` and the turbulence :math:`I_{ik}`, and makes a wake by its thrust
:math:`C_{ik}`; :math:`W_{pik}` is the deficit that all wakes together leave at point p of its
rotor, a share :math:`c_p` of it; :math:`e_{ik}` is its power and :math:`E_k` that of the farm:

.. math::

    \max \quad & \sum_k w_k E_k                                                       \tag{1} \\
    \text{s.t.} \quad & E_k \le \sum_i e_{ik}, \quad E_k \le E^{max}, \quad
        e_{ik} \le r_{ik} P_i\bigl(u_k U_{ik} \cos^{q/3} \gamma_{it}\bigr), \quad
        e_{ik} \le \overline e_i                                                      \tag{2} \\
      & U_{ik}^3 = \sum_p c_p (1 - W_{pik})^3                                         \tag{3} \\
      & W_{pik}^2 + 2 \varepsilon W_{pik} = \sum_j d_{pji}^2(\gamma_{jt}, C_{jk}, I_{jk}) \tag{4} \\
      & C_{ik} = r_{ik} \, C_T(u_k U_{ik}) \cos\gamma_{it}                            \tag{5} \\
      & I_{ik}^2 = I_\infty^2 + \kappa_{ik}^2 \, a(\gamma_{jt}, C_{jk})^{1.6},
        \quad j = j(i, k)                                                             \tag{6} \\
      & \underline\gamma_i \le \gamma_{it} \le \overline\gamma_i                      \tag{7} \\
      & |\Delta\theta_t - \gamma_{it} + \gamma_{i,t-1}| \le \dot\gamma                    \tag{8} \\
      & \underline r \le r_{ik} \le 1                                                \tag{9}

The turbine's curves are :math:`P_i` and :math:`C_T`, and q is the exponent of the cosine by which
its power falls. One step with one wind is a set-point; one step with several winds is a robust
set-point, the best on average over a spread of directions and speeds; several steps are a schedule,
in which the wind turns by :math:`\Delta\theta_t` and a nacelle by at most :math:`\dot\gamma`.

A turbine may be derated to a share :math:`r_{ik}` of its power, and its thrust falls by as much;
unless that is asked for, the share is 1, and a farm above its cap is curtailed without regard to
its wakes. With derating the first and third part of (2) are equalities, so that the set-points add
up to what the grid takes.

The rated power :math:`\overline e_i` is a bound, and below it :math:`P_i` goes on rising where the
wind is stronger. The corner in between would stop a search in which many turbines stand at it.

The wakes come one after the other, so U, W, C and I are functions of the yaws. They are variables
all the same: eliminated, they would couple every turbine with all those upstream, whereas here each
row holds a few neighbours, and second derivatives couple only a turbine's own yaw, thrust and
turbulence. (4) is the root of the sum of squares, whose slope would be infinite where there is
no wake, moved by :math:`\varepsilon`. The main source j(i, k) of turbulence and its
:math:`\kappa_{ik}` are those of the wakes the program was built from: solve, find the wakes at
the solution, and solve again where they differ.

Zero yaw in a wind along a row of turbines satisfies the first-order conditions, and is no maximum:
start elsewhere.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from math import inf, prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from formulations import lifted_rows as rows
from formulations.farm_in_wind import FarmInWind
from formulations.farm_wakes import Wakes
from formulations.separable import Family, SeparableProgram

Floats = NDArray[np.float64]
Places = NDArray[np.intp]


class Turns(NamedTuple):
    """How far nacelles may turn from one step to the next."""

    most: float  # rad
    shifts: Floats  # (T - 1,) by which the wind turns [rad]


@dataclass(frozen=True, eq=False)
class FarmYaw:
    """The program, the places of its decisions, and where to start.

    Parameters
    ----------
    program
        Rows and bounds; the objective is minus (1), as a fraction of ``scale``.
    gamma
        Places of the misalignments among its variables, shape ``(T, n)``.
    r
        Places of the shares of power, shape ``(K, n)``.
    start
        A point at which all rows but those of (8) hold, to within their rounded corners.
    scale
        Power of the farm without wakes [W].
    """

    program: SeparableProgram
    gamma: Places
    r: Places
    start: Floats
    scale: float


def farm_yaw(
    farm: FarmInWind,
    wakes: Wakes,
    *,
    bounds: tuple[Floats, Floats],
    cap: float = inf,
    turns: Turns | None = None,
    least: float = 1.0,
) -> FarmYaw:
    r"""Build the program (1)-(9).

    Parameters
    ----------
    farm
        The farm and its winds.
    wakes
        Its wakes at the misalignments where the search shall start.
    bounds
        Lower and upper bounds of the misalignments [rad], of shape ``(n,)`` or ``(T, n)``.
    cap
        The most that the farm may deliver in any wind [W].
    turns
        How far nacelles may turn between the steps; unless given, as far as they like.
    least
        The share of its power to which a turbine may be derated [-].
    """
    scale = farm.free_power() or 1.0
    x = _variables(farm, wakes)
    row = count()

    K = len(x.E)
    objective = Family(
        rows.itself(), x.E[None], -farm.weights[None], np.zeros((1, K), dtype=np.intp)
    )  # (1)
    derated = least < 1.0
    constraints = [
        *_powers(farm, x, row, scale, derated=derated),  # (2)
        *_means(farm, x, row),  # (3)
        *_deficits(farm, wakes, x, row),  # (4)
        *_thrusts(farm, x, row),  # (5)
        *_turbulence(farm, wakes, x, row),  # (6)
    ]
    m = next(row)
    lower_g, upper_g = np.zeros(m), np.zeros(m)
    if not derated:
        lower_g[: x.E.size + x.e.size] = -inf
    if turns is not None:
        constraints += _turns(x, turns, m)  # (8)
        most = np.full(x.gamma[1:].size, turns.most)
        lower_g, upper_g = np.append(lower_g, -most), np.append(upper_g, most)

    lower_x, upper_x = _bounds(farm, wakes, x)
    upper_x[x.E], upper_x[x.e] = cap / scale, farm.rated_powers / scale  # (2)
    lower_x[x.gamma], upper_x[x.gamma] = bounds  # (7)
    lower_x[x.r], upper_x[x.r] = least, 1.0  # (9)
    program = SeparableProgram(objective, constraints, lower_x, upper_x, lower_g, upper_g)
    return FarmYaw(program, x.gamma, x.r, _start(wakes, x, cap, scale), scale)


class _Variables(NamedTuple):
    """Places of the variables; -1 where a turbine meets no wake."""

    gamma: Places  # (T, n)
    C: Places  # (K, n)
    I: Places  # (K, n)  # noqa: E741
    U: Places  # (K, n)
    r: Places  # (K, n)
    E: Places  # (K,)
    e: Places  # (K, n)
    W: Places  # (P, K, n)

    @property
    def size(self) -> int:
        """How many there are."""
        return 1 + int(max(self.e.max(), self.W.max()))

    @property
    def waked(self) -> NDArray[np.bool_]:
        """Which turbines meet a wake, shape ``(K, n)``."""
        waked: NDArray[np.bool_] = self.W[0] >= 0
        return waked


def _variables(farm: FarmInWind, wakes: Wakes) -> _Variables:
    P, K, n = wakes.W.shape
    place = count()
    shapes = wakes.gamma.shape, (K, n), (K, n), (K, n), (K, n), (K,), (K, n)
    gamma, C, I, U, r, E, e = (_numbers(place, shape) for shape in shapes)  # noqa: E741
    W = np.full((P, K, n), -1)
    waked = np.zeros((K, n), dtype=bool)
    waked[wakes.wind, wakes.target] = True
    W[:, waked] = _numbers(place, (P, int(waked.sum())))
    return _Variables(gamma, C, I, U, r, E, e, W)


def _numbers(count: Iterator[int], shape: tuple[int, ...]) -> Places:
    """Return the next numbers, in an array."""
    return np.fromiter(count, dtype=np.intp, count=prod(shape)).reshape(shape)


def _powers(
    farm: FarmInWind, x: _Variables, row: Iterator[int], scale: float, *, derated: bool
) -> Iterator[Family]:
    K, n = x.e.shape
    of_farm, of_turbine = _numbers(row, (K,)), _numbers(row, (K, n))
    yield Family(rows.itself(), x.E[None], np.ones((1, K)), of_farm[None])
    shares = np.repeat(of_farm, n)[None]
    yield Family(rows.itself(), x.e.reshape(1, -1), -np.ones((1, K * n)), shares)
    for c, k, i in _kinds(farm):
        curve = farm.curve(c) if derated else farm.curve(c).rising()
        power = rows.power(curve, farm.air_density, scale)
        v = np.array([x.e[k, i], x.gamma[farm.steps[k], i], x.U[k, i], x.r[k, i]])
        yield Family(power, v, farm.speeds[k][None], of_turbine[k, i][None])


def _means(farm: FarmInWind, x: _Variables, row: Iterator[int]) -> Iterator[Family]:
    _, i = np.nonzero(x.waked)
    v = np.vstack([x.U[x.waked][None], x.W[:, x.waked]])
    yield Family(rows.mean(len(x.W)), v, farm.shares()[:, i], _numbers(row, (1, len(i))))


def _deficits(
    farm: FarmInWind, wakes: Wakes, x: _Variables, row: Iterator[int]
) -> Iterator[Family]:
    W = x.W[:, x.waked]
    at = np.full(x.W.shape, -1)
    at[:, x.waked] = _numbers(row, W.shape)
    yield Family(rows.superposed(len(W)), W, np.zeros((0, W.shape[1])), at[:, x.waked])
    k, j, i = wakes.wind, wakes.source, wakes.target
    v = np.array([x.gamma[farm.steps[k], j], x.C[k, j], x.I[k, j]])
    yield Family(rows.taken(len(farm.rows)), v, wakes.place, at[:, k, i])


def _thrusts(farm: FarmInWind, x: _Variables, row: Iterator[int]) -> Iterator[Family]:
    for c, k, i in _kinds(farm):
        v = np.array([x.gamma[farm.steps[k], i], x.U[k, i], x.r[k, i], x.C[k, i]])
        yield Family(
            rows.thrust(farm.curve(c)), v, farm.speeds[k][None], _numbers(row, (1, len(k)))
        )


def _turbulence(
    farm: FarmInWind, wakes: Wakes, x: _Variables, row: Iterator[int]
) -> Iterator[Family]:
    k, i = np.nonzero(wakes.main >= 0)
    j = wakes.main[k, i]
    v = np.array([x.I[k, i], x.gamma[farm.steps[k], j], x.C[k, j]])
    p = np.array([wakes.kappa[k, i], np.full(len(k), farm.turbulence)])
    yield Family(rows.turbulence(), v, p, _numbers(row, (1, len(k))))


def _turns(x: _Variables, turns: Turns, first: int) -> Iterator[Family]:
    T, n = x.gamma.shape
    v = np.array([x.gamma[1:].ravel(), x.gamma[:-1].ravel()])
    shifts = np.repeat(turns.shifts, n)[None]
    yield Family(rows.turned(), v, shifts, first + np.arange((T - 1) * n)[None])


def _kinds(farm: FarmInWind) -> Iterator[tuple[int, Places, Places]]:
    """Yield every power curve, and the winds and turbines it holds for."""
    for c in range(len(farm.curves)):
        k, i = np.meshgrid(np.arange(len(farm.speeds)), np.flatnonzero(farm.curve_of == c))
        yield c, k.ravel(), i.ravel()


def _bounds(farm: FarmInWind, wakes: Wakes, x: _Variables) -> tuple[Floats, Floats]:
    """Return bounds that no wake reaches, but for those of what is fixed."""
    lower, upper = np.full(x.size, -inf), np.full(x.size, inf)
    lower[x.C], upper[x.C] = 0.0, 0.99995
    lower[x.I] = farm.turbulence
    lower[x.U] = 0.01
    lower[x.W[:, x.waked]], upper[x.W[:, x.waked]] = 0.0, 0.99
    free, calm = ~x.waked, wakes.main < 0
    lower[x.U[free]] = upper[x.U[free]] = wakes.U[free]
    lower[x.I[calm]] = upper[x.I[calm]] = farm.turbulence
    return lower, upper


def _start(wakes: Wakes, x: _Variables, cap: float, scale: float) -> Floats:
    start = np.empty(x.size)
    start[x.gamma], start[x.C], start[x.I], start[x.U] = wakes.gamma, wakes.C_T, wakes.I, wakes.U
    start[x.r], start[x.e] = 1.0, wakes.powers / scale
    start[x.E] = np.minimum(wakes.powers.sum(axis=1), cap) / scale
    start[x.W[:, x.waked]] = wakes.W[:, x.waked]
    return start
