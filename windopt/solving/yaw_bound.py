r"""A proven bound on what a steered farm can deliver.

Without wakes each turbine would deliver its most; wakes that no yaw can push aside let it deliver
less. From upstream to downstream, intervals hold each turbine's wind, thrust and turbulence for all
misalignments within the bounds. The range of each rotor is cut into cells, and for each cell
:mod:`windopt.solving.wake_intervals` gives the least that its wake slows each rotor behind it.

Turned far aside, a rotor lets those behind it deliver more and delivers less itself, so its cell
must be the same for all. Kept for all wakes at once, that would be as hard as steering itself.
Each turbine i keeps it for itself and for the one source j(i) that can slow it most, and takes the
best cell of every other source. The sum

.. math:: \sum_i P_i(c_i, c_{j(i)}) \ge \text{power of the farm, for the cells } c \text{ it is in}

then runs over a forest, whose best cells are found from downstream to upstream. In several winds
the bound is the weighted mean of the bounds of each.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.yaw_problem import YawProblem
from windopt.solving.compiled_wakes import Row, Tables
from windopt.solving.exact.compiled import compiled
from windopt.solving.interrupts import uninterrupted
from windopt.solving.wake_intervals import PIECES, Box, Spread, piece, sideways, spread, upwards
from windopt.solving.wake_sweep import in_row, tables_of

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

CELLS = 16
"""Into how many cells the range of each rotor is cut."""

SAFE = 1 + 1e-7
"""Factor that covers rounding, and wakes too far aside to be looked at."""

UNWAKED = "every turbine without wakes"
BY_INTERVALS = "wakes that no yaw can push aside, by intervals"
"""Sources of bounds."""


def closest_bound(problem: YawProblem) -> tuple[float, str]:
    """Return the lower of the proven bounds on a farm's power [W], and its source."""
    intervals = yaw_bound(problem)
    return (intervals, BY_INTERVALS) if intervals < problem.bound else (problem.bound, UNWAKED)


def yaw_bound(problem: YawProblem) -> float:
    """Return a power [W] that the farm exceeds with no misalignments within their bounds."""
    tables, unwaked = tables_of(problem), problem.unwaked.sum(axis=1)
    bounds = np.empty(len(problem.weights))
    for s in range(len(bounds)):
        row, order = in_row(problem, s)
        edges = _edges(problem.lower[order], problem.upper[order])
        with uninterrupted():
            powers, parent = most_powers(row, tables, edges)
            bounds[s] = min(best_cells(powers, parent) * SAFE, unwaked[s])
    return float(np.minimum(bounds, problem.farm_cap) @ problem.weights)


def _edges(lower: Floats, upper: Floats) -> Floats:
    """Return the edges of each rotor's cells, none of which straddles zero, ``(n, CELLS + 1)``."""
    edges = np.linspace(lower, upper, CELLS + 1, axis=1)
    rows = np.flatnonzero((lower < 0) & (upper > 0))
    nearest = np.clip(np.abs(edges[rows]).argmin(axis=1), 1, CELLS - 1)
    for i, at in zip(rows, nearest, strict=True):
        edges[i] = np.r_[
            np.linspace(lower[i], 0.0, at + 1), np.linspace(0.0, upper[i], CELLS - at + 1)[1:]
        ]
    return edges


@compiled
def slowed_by(
    row: Row, i: int, j: int, edges: Floats, C: Floats, turbulence: Floats, least: Floats
) -> tuple[float, float]:
    """Bound the squared deficits that turbine i makes at the points of turbine j.

    Parameters
    ----------
    edges
        Of the cells of i.
    C, turbulence
        Intervals of its thrust coefficient and turbulence.
    least
        Is filled with the least squares for each cell and point, ``(CELLS, 9)``.

    Returns
    -------
    The largest deficit anywhere, and the smallest share of points always slowed noticeably.
    """
    D, most, always = row.D[i], 0.0, 9
    dx = (row.x[j] - row.x[i]) / D
    least[:] = np.inf
    for cell in range(len(edges) - 1):
        box = Box(edges[cell], edges[cell + 1], C[0], C[1], turbulence[0], turbulence[1])
        for p in range(PIECES * PIECES):
            s = spread(dx, piece(box, p // PIECES, p % PIECES))
            most = max(most, _into(row, i, j, s, least[cell]))
        noticed = 0
        for p in range(9):
            noticed += np.sqrt(least[cell, p]) * row.u0[j, p % 3] > 0.05
        always = min(always, noticed)
    return most, always / 9


@compiled
def _into(row: Row, i: int, j: int, s: Spread, least: Floats) -> float:
    """Lower ``least`` to the squares of a wake at the nine points, and return its most."""
    D, most = row.D[i], 0.0
    low_up, high_up = np.empty(3), np.empty(3)
    for r in range(3):
        dz = (row.H[j] - row.H[i] + 0.25 * (r - 1) * row.D[j]) / D
        low_up[r], high_up[r] = upwards(s, dz)
    for c in range(3):
        dy = (row.y[j] - row.y[i] + 0.25 * (c - 1) * row.D[j]) / D
        low, high = sideways(s, dy)
        for r in range(3):
            least[3 * c + r] = min(least[3 * c + r], (low * low_up[r]) ** 2)
            most = max(most, high * high_up[r])
    return most


@compiled
def mean_wind(row: Row, i: int, squares: Floats) -> float:
    """Return the cubic mean of the wind over a rotor [m/s] behind squared deficits."""
    cubes = 0.0
    for p in range(9):
        cubes += (row.u0[i, p % 3] * (1 - np.sqrt(squares[p]))) ** 3
    mean: float = np.cbrt(cubes / 9)
    return mean


@compiled
def thrusts(tables: Tables, kind: int, low: float, high: float) -> tuple[float, float]:
    """Return the interval of the thrust coefficient in winds from ``low`` to ``high``."""
    first, last = tables.first[kind], tables.first[kind + 1]
    at, C_T = tables.speeds[first:last], tables.thrusts[first:last]
    least, most = 1.0, 0.0
    for v in (low, high):
        inside = at[0] <= v <= at[-1]
        value = np.interp(v, at, C_T) if inside else 0.0
        least, most = min(least, value), max(most, value)
    for p in range(len(at)):
        if low <= at[p] <= high:
            least, most = min(least, C_T[p]), max(most, C_T[p])
    if low < at[0] or high > at[-1]:
        least = 0.0
    return min(max(least, 1e-4), 0.9999), min(max(most, 1e-4), 0.9999)


@compiled
def most_power(tables: Tables, kind: int, v: float) -> float:
    """Return the largest power [W] in any wind up to ``v``, already corrected for yaw."""
    first, last = tables.first[kind], tables.first[kind + 1]
    at, powers = tables.speeds[first:last], tables.powers[first:last]
    most = np.interp(v, at, powers) if at[0] <= v <= at[-1] else 0.0
    for p in range(len(at)):
        if at[p] <= v:
            most = max(most, powers[p])
    return most


@compiled
def raised(row: Row, i: int, j: int, cos: Floats, C: float, share: float) -> float:
    """Return the turbulence at j behind i whose yaw's cosines and thrust are at their extremes.

    ``cos`` holds the cosine that counts for the thrust, and the one that counts for the induction.
    """
    dx = (row.x[j] - row.x[i]) / row.D[i]
    a = 0.5 / cos[1] * (1 - np.sqrt(1 - C * cos[0] ** 2))
    added = share * 0.5 * a**0.8 * row.ambient**0.1 * dx**-0.32
    total: float = np.sqrt(row.ambient**2 + added**2)
    return total


@compiled
def roughen(
    row: Row, i: int, j: int, edges: Floats, C: Floats, always: float, turbulence: Floats
) -> None:
    """Widen and lift the interval of j's turbulence by what i may and must add."""
    nearest = abs(row.y[j] - row.y[i])
    side = 0.25 * row.D[j]
    if row.x[j] - row.x[i] > 15.0 * row.D[i] or nearest - side >= 2 * row.D[i]:
        return
    low = min(np.cos(edges[0]), np.cos(edges[-1]))
    high = 1.0 if edges[0] <= 0.0 <= edges[-1] else max(np.cos(edges[0]), np.cos(edges[-1]))
    most = raised(row, i, j, np.array([high, low]), C[1], 1.0)
    turbulence[j, 1] = max(turbulence[j, 1], most)
    if nearest + side < 2 * row.D[i]:
        least = raised(row, i, j, np.array([low, high]), C[0], always)
        turbulence[j, 0] = max(turbulence[j, 0], least)


@compiled
def most_powers(row: Row, tables: Tables, edges: Floats) -> tuple[Floats, Places]:
    """Return what each turbine can deliver at most, and the source that decides it.

    Returns
    -------
    Powers [W] by the cell of its source and its own, shape ``(n, CELLS, CELLS)``, and the
    sources, -1 where there is none.
    """
    n, cells = len(row.x), edges.shape[1] - 1
    least = np.zeros((len(row.target), cells, 9))
    most = np.zeros((n, 9))
    turbulence = np.full((n, 2), row.ambient)
    powers, parent = np.zeros((n, cells, cells)), np.full(n, -1)
    for i in range(n):
        by_cell, parent[i] = decided(row, i, least)
        winds = np.array([mean_wind(row, i, by_cell[c]) for c in range(cells)])
        k = row.kind[i]
        for c in range(cells):
            straight = np.cos(min(abs(edges[i, c]), abs(edges[i, c + 1])))
            own = tables.density[k] * straight ** tables.cosine[k]
            for source in range(cells):
                powers[i, source, c] = most_power(tables, k, winds[source] * own)
        C = np.array(thrusts(tables, k, mean_wind(row, i, most[i]), winds.max()))
        for e in range(row.first[i], row.first[i + 1]):
            j = row.target[e]
            deepest, always = slowed_by(row, i, j, edges[i], C, turbulence[i], least[e])
            most[j] += deepest * deepest
            if deepest > 0:
                roughen(row, i, j, edges[i], C, always, turbulence)
    return powers, parent


@compiled
def decided(row: Row, i: int, least: Floats) -> tuple[Floats, int]:
    """Return the least squared deficits at a turbine by the cell of its main source, and it."""
    cells = least.shape[1]
    sums, main, strongest = np.zeros(9), -1, 0.0
    for p in range(row.first_in[i], row.first_in[i + 1]):
        e = row.into[p]
        lowest = np.array([least[e, :, q].min() for q in range(9)])
        sums += lowest
        difference = 0.0
        for c in range(cells):
            difference = max(difference, (least[e, c] - lowest).sum())
        if difference > strongest:
            main, strongest = e, difference
    by_cell = np.zeros((cells, 9))
    for c in range(cells):
        by_cell[c] = sums
        if main >= 0:
            for q in range(9):
                by_cell[c, q] += least[main, c, q] - least[main, :, q].min()
    return by_cell, (row.source[main] if main >= 0 else -1)


@compiled
def best_cells(powers: Floats, parent: Places) -> float:
    """Return the largest sum of powers for which every turbine has one cell."""
    n, cells = powers.shape[0], powers.shape[1]
    behind = np.zeros((n, cells))  # what the turbines that a source decides deliver, by its cell
    total = 0.0
    for i in range(n - 1, -1, -1):
        best = np.array([(powers[i, c] + behind[i]).max() for c in range(cells)])
        if parent[i] >= 0:
            behind[parent[i]] += best
        else:
            total += best[0]
    return total
