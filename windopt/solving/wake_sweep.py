"""The exact wakes, compiled and kept: what the farm delivers if one rotor turns.

Searches that turn one rotor at a time ask for thousands of farm powers that differ in a few wakes.
A :class:`Sweep` keeps what every wake takes from every rotor behind it. When a rotor turns, its own
wake is new, then those of the rotors which that wake reaches, and so on downstream; all others are
as they were. A trial costs microseconds for most rotors. The model is that of
:mod:`windopt.wakes`, with which it agrees to rounding and by which every answer is judged.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.yaw_problem import ROTOR_POINTS, YawProblem
from windopt.solving.compiled_wakes import Kept, Row, Tables, keep, passed
from windopt.solving.interrupts import uninterrupted
from windopt.wakes.gaussian import K_A, K_B

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

SIGMAS = 6.0
"""How many widths of a wake count: what is farther aside is slowed by less than 1e-8."""

MOVED = 1.1
"""How far aside a wake is moved at most [diameters]."""

MOST_INDUCTION = 0.5
"""Where momentum theory ends."""


class _InOneWind:
    """One wind: its row of turbines, and the wakes that are kept and tried."""

    def __init__(self, problem: YawProblem, s: int, tables: Tables, yaw: Floats) -> None:
        self.row, self.order = in_row(problem, s)
        self.place = self.order.argsort()
        self.tables = tables
        self._kept, self._new = _no_wakes(self.row), _no_wakes(self.row)
        self._new.changed[:] = True
        self.total = passed(self.row, tables, 0, yaw[self.order], self._kept, self._new)
        keep(self.row, 0, self._kept, self._new)

    def more(self, turbine: int, gamma: Floats) -> float:
        """Return how much more power there is [W] if one turbine turns to its yaw in ``gamma``."""
        begin = int(self.place[turbine])
        self._new.changed[:] = False
        self._new.changed[begin] = True
        return passed(self.row, self.tables, begin, gamma, self._kept, self._new)

    def turn(self, turbine: int, gamma: Floats) -> None:
        """Turn it."""
        self.total += self.more(turbine, gamma)
        keep(self.row, int(self.place[turbine]), self._kept, self._new)


class Sweep:
    """The farm at its present misalignments, any of which may be tried or changed.

    Parameters
    ----------
    problem
        The farm and its winds.
    yaw
        Misalignments [rad], shape ``(n,)``.
    """

    @uninterrupted()
    def __init__(self, problem: YawProblem, yaw: Floats) -> None:
        self.problem = problem
        self.yaw: Floats = np.array(yaw, dtype=float)
        tables = tables_of(problem)
        winds = range(len(problem.wind_speeds))
        self._winds = [_InOneWind(problem, s, tables, self.yaw) for s in winds]

    @uninterrupted()
    def turn(self, turbine: int, yaw: float) -> None:
        """Turn one rotor to a misalignment [rad]."""
        self.yaw[turbine] = yaw
        for wind in self._winds:
            wind.turn(turbine, self.yaw[wind.order])

    @property
    def power(self) -> float:
        """The objective at the present misalignments [W]."""
        return self._objective(np.array([wind.total for wind in self._winds]))

    @uninterrupted()
    def tried(self, turbine: int, yaws: Floats) -> Floats:
        """Return the objective [W] with one rotor turned, for each of ``yaws`` [rad]."""
        powers = np.empty((len(yaws), len(self._winds)))
        for s, wind in enumerate(self._winds):
            gamma = self.yaw[wind.order]
            for b, yaw in enumerate(yaws):
                gamma[wind.place[turbine]] = yaw
                powers[b, s] = wind.total + wind.more(turbine, gamma)
        return np.array([self._objective(totals) for totals in powers])

    def _objective(self, totals: Floats) -> float:
        return float(np.minimum(totals, self.problem.farm_cap) @ self.problem.weights)

    def downstream_order(self) -> Places:
        """Return the turbines from upstream to downstream in the mean direction."""
        theta, w = self.problem.wind_directions, self.problem.weights
        mean = np.arctan2(w @ np.sin(theta), w @ np.cos(theta))
        along: Floats = -self.problem.turbines @ np.array([np.sin(mean), np.cos(mean)])
        return along.argsort(kind="stable")


def tables_of(problem: YawProblem) -> Tables:
    """Return a problem's power curves, one after the other."""
    curves = problem.curves
    lengths = [len(curve.wind_speeds) for curve in curves]
    first = np.concatenate([[0], np.cumsum(lengths)]).astype(np.intp)
    speeds, powers, thrusts = (
        np.concatenate([np.array(getattr(curve, name), dtype=float) for curve in curves])
        for name in ("wind_speeds", "powers", "thrust_coefficients")
    )
    density = np.array([(problem.air_density / curve.air_density) ** (1 / 3) for curve in curves])
    cosine = np.array([curve.yaw_exponent / 3 for curve in curves])
    return Tables(first, speeds, powers, thrusts, density, cosine)


def in_row(problem: YawProblem, s: int) -> tuple[Row, Places]:
    """Turn the farm into a wind, sort it along it, and list who may be in whose wake."""
    east, north = (problem.turbines - problem.turbines.mean(axis=0)).T
    theta = problem.wind_directions[s] - 1.5 * np.pi
    x = east * np.cos(theta) - north * np.sin(theta)
    order = x.argsort(kind="stable")
    x, y = x[order], (east * np.sin(theta) + north * np.cos(theta))[order]
    D, H = problem.rotor_diameters[order], problem.hub_heights[order]
    heights = H[:, None] + D[:, None] * ROTOR_POINTS
    u0 = problem.wind_speeds[s] * (heights / problem.reference_height) ** problem.shear
    dx, dy = x - x[:, None], np.abs(y - y[:, None])
    distance = np.where(dy < 4 * D[:, None], dx / D[:, None], 0.0)
    sigma = D[:, None] / np.sqrt(8) + fastest_growth(problem.turbulence, distance) * dx
    near = dy < SIGMAS * sigma + MOVED * D[:, None] + 0.25 * D
    source, target = np.nonzero((dx > 0.1) & near)
    into = target.argsort(kind="stable")
    numbers = np.arange(len(x) + 1)
    first, first_in = np.searchsorted(source, numbers), np.searchsorted(target[into], numbers)
    pairs = first, source, target, first_in, into
    return Row(x, y, D, H, u0, problem.curve_of[order], *pairs, problem.turbulence), order


def _no_wakes(row: Row) -> Kept:
    n, E = len(row.x), len(row.target)
    raised = np.full((E, 3), row.ambient)
    return Kept(np.zeros((E, 9)), raised, np.zeros(n), np.zeros(n, dtype=np.bool_))


def fastest_growth(ambient: float, distance: Floats) -> float:
    """Return by how much the roughest wake of a farm grows per distance.

    Its turbulence is what the turbine nearest behind another may find; ``distance`` is in
    diameters, zero where there is none behind.
    """
    nearest = max(1.0, float(distance[distance > 0].min(initial=1e3)))
    added = 0.5 * MOST_INDUCTION**0.8 * ambient**0.1 * nearest**-0.32
    return K_A * float(np.hypot(ambient, added)) + K_B
