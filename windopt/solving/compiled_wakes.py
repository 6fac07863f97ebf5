"""The equations of :mod:`windopt.wakes`, compiled, one wake and one rotor at a time.

They agree with their twin to rounding. What every wake takes from every rotor behind it is kept, so
that after a turn only the wakes that change are found anew.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.compiled import compiled
from windopt.wakes.gaussian import ALPHA, BETA, K_A, K_B

Floats = NDArray[np.float64]
Places = NDArray[np.intp]

UNCHANGED = 1e-14
"""Squares of deficits that differ by less are the same [m2/s2]."""


class Tables(NamedTuple):
    """All power curves, one after the other."""

    first: Places  # of each curve; one more than curves
    speeds: Floats
    powers: Floats
    thrusts: Floats
    density: Floats  # factor on the wind speed, of each curve
    cosine: Floats  # exponent of the cosine, of each curve


class Row(NamedTuple):
    """A farm in one wind, from upstream to downstream."""

    x: Floats  # (n,) m
    y: Floats
    D: Floats
    H: Floats
    u0: Floats  # (n, 3) free wind at the rows of points [m/s]
    kind: Places  # (n,) which curve
    first: Places  # (n + 1,) of the pairs that a turbine is the source of
    source: Places  # (E,) of each pair
    target: Places
    first_in: Places  # (n + 1,) of the pairs that a turbine is the target of, in `into`
    into: Places
    ambient: float  # turbulence intensity


class Kept(NamedTuple):
    """What every pair's wake takes and adds, and what every turbine delivers."""

    squares: Floats  # (E, 9) of the deficits at the points of the target [m2/s2]
    raised: Floats  # (E, 3) turbulence intensity at its columns
    powers: Floats  # (n,) W
    changed: NDArray[np.bool_]  # (n,) whether a turbine, and so its wake, is to be found anew


class Shed(NamedTuple):
    """The wake that a rotor sheds into one column of points; lengths in its diameters."""

    cos: float
    C_T: float
    k: float
    x_0: float  # end of the near wake, of the velocity and of the deflection
    x_1: float
    tan: float  # of the skew
    sigma_y: float  # at x_1, of the deflection
    sigma_z: float
    m: float
    bend: float


class Section(NamedTuple):
    """A wake at some distance; lengths in diameters of its rotor."""

    centre: float  # deficit in its centre
    sigma_y: float  # widths
    sigma_z: float
    delta: float  # how far aside its centre is


@compiled
def shed(gamma: float, C_T: float, turbulence: float) -> Shed:
    """Return the wake of a rotor; see :mod:`windopt.wakes.gaussian` for the equations."""
    cos = np.cos(gamma)
    k = K_A * turbulence + K_B
    u_0, root = np.sqrt(1 - C_T), np.sqrt(1 - C_T * cos)
    slowing = np.sqrt(2.0) * (4 * ALPHA * turbulence + 2 * BETA * (1 - u_0))
    theta = -0.3 * gamma / cos * (1 - root)
    sigma_z = 0.5 * np.sqrt(C_T * cos / (2 * (1 - root)) / (1 + u_0))
    C_0 = 1 - u_0
    E_0 = C_0**2 - 3 * np.exp(1 / 12) * C_0 + 3 * np.exp(1 / 3)
    m = np.sqrt(C_0 * (2 - C_0))
    bend = theta * E_0 / 5.2 * np.sqrt(sigma_z * cos * sigma_z) / (k * m)
    x_0, x_1 = cos * (1 + u_0) / slowing, cos * (1 + root) / slowing
    return Shed(cos, C_T, k, x_0, x_1, np.tan(theta), sigma_z * cos, sigma_z, m, bend)


@compiled
def deflection(w: Shed, dx: float) -> float:
    """Return how far aside the wake's centre is at a distance [diameters]."""
    if dx <= w.x_1:
        return w.tan * dx
    far = w.k * (dx - w.x_1)
    s = 1.6 * np.sqrt((far + w.sigma_y) * (far + w.sigma_z) / (w.sigma_y * w.sigma_z))
    turn = np.log((1.6 + w.m) * (s - w.m) / ((1.6 - w.m) * (s + w.m)))
    moved: float = w.tan * w.x_1 + w.bend * turn
    return moved


@compiled
def section(w: Shed, dx: float) -> Section:
    """Return the cross-section of a wake at a distance [diameters]."""
    sigma_0 = 8**-0.5
    if dx < w.x_0:
        ramp = dx / w.x_0
        start = (1 - ramp) * 0.501 * np.sqrt(w.C_T / 2)
        sigma_y, sigma_z = start + ramp * sigma_0 * w.cos, start + ramp * sigma_0
    else:
        growth = w.k * (dx - w.x_0)
        sigma_y, sigma_z = growth + sigma_0 * w.cos, growth + sigma_0
    free = 1 - w.C_T * w.cos / (8 * sigma_y * sigma_z)
    centre = 1 - np.sqrt(min(max(free, 0.0), 1.0))
    return Section(centre, sigma_y, sigma_z, deflection(w, dx))


@compiled
def fade(row: Row, i: int, j: int, sigma_z: float, left: Floats) -> None:
    """Find how much of a wake's deficit is left at each row of points."""
    for r in range(3):
        up = (row.H[j] - row.H[i] + 0.25 * (r - 1) * row.D[j]) / (row.D[i] * sigma_z)
        left[r] = np.exp(-0.5 * up * up)


@compiled
def slow(row: Row, i: int, j: int, c: int, s: Section, left: Floats, squares: Floats) -> int:
    """Find by how much a wake slows a column of points; return how many of them noticeably."""
    dy = (row.y[j] - row.y[i] + 0.25 * (c - 1) * row.D[j]) / row.D[i]
    aside = (dy - s.delta) / s.sigma_y
    lateral = s.centre * np.exp(-0.5 * aside * aside)
    noticed = 0
    for r in range(3):
        loss = lateral * left[r] * row.u0[j, r]
        squares[3 * c + r] = loss * loss
        noticed += loss > 0.05
    return noticed


@compiled
def roughen(row: Row, i: int, j: int, added: float, raised: Floats) -> None:
    """Find the turbulence intensity to which ``added`` raises each column of points."""
    raised[:] = row.ambient
    dx = (row.x[j] - row.x[i]) / row.D[i]
    if added == 0 or dx > 15.0:
        return
    added *= dx**-0.32
    for c in range(3):
        dy = row.y[j] - row.y[i] + 0.25 * (c - 1) * row.D[j]
        if abs(dy) < 2 * row.D[i]:
            raised[c] = np.sqrt(added * added + row.ambient * row.ambient)


@compiled
def interpolated(v: float, first: int, last: int, at: Floats, values: Floats) -> float:
    """Return the tabulated value at ``v``, zero outside the table."""
    if not at[first] <= v <= at[last - 1]:
        return 0.0
    p = first + 1
    while at[p] < v:
        p += 1
    share = (v - at[p - 1]) / (at[p] - at[p - 1])
    value: float = values[p - 1] + share * (values[p] - values[p - 1])
    return value


@compiled
def operate(row: Row, tables: Tables, i: int, gamma: float, slowed: Floats) -> tuple[float, float]:
    """Return a rotor's power [W] and thrust coefficient behind deficits of these squares."""
    cubes = 0.0
    for c in range(3):
        for r in range(3):
            cubes += (row.u0[i, r] - np.sqrt(slowed[3 * c + r])) ** 3
    v = np.cbrt(cubes / 9)
    k = row.kind[i]
    first, last = tables.first[k], tables.first[k + 1]
    C_T = interpolated(v, first, last, tables.speeds, tables.thrusts)
    effective = tables.density[k] * v * np.cos(gamma) ** tables.cosine[k]
    power = interpolated(effective, first, last, tables.speeds, tables.powers)
    return power, min(max(C_T, 1e-4), 0.9999) * np.cos(gamma)


@compiled
def pass_wake(
    row: Row, i: int, gamma: float, C_T: float, own: Floats, kept: Kept, new: Kept
) -> None:
    """Find the wake of turbine i, and mark the turbines for which it is not what it was."""
    columns = (shed(gamma, C_T, own[0]), shed(gamma, C_T, own[1]), shed(gamma, C_T, own[2]))
    alike = own[0] == own[1] == own[2]
    cos = np.cos(gamma)
    a = 0.5 / cos * (1 - np.sqrt(1 - C_T * cos))
    strength = 0.5 * a**0.8 * row.ambient**0.1
    left = np.empty(3)
    for e in range(row.first[i], row.first[i + 1]):
        j = row.target[e]
        dx = (row.x[j] - row.x[i]) / row.D[i]
        s = section(columns[0], dx)
        fade(row, i, j, s.sigma_z, left)
        noticed = slow(row, i, j, 0, s, left, new.squares[e])
        for c in (1, 2):
            if not alike:
                s = section(columns[c], dx)
                fade(row, i, j, s.sigma_z, left)
            noticed += slow(row, i, j, c, s, left, new.squares[e])
        roughen(row, i, j, noticed / 9 * strength, new.raised[e])
        new.changed[j] = new.changed[j] or differs(kept, new, e)


@compiled
def differs(kept: Kept, new: Kept, e: int) -> bool:
    """Whether a pair's wake is not what it was."""
    for p in range(9):
        if abs(new.squares[e, p] - kept.squares[e, p]) > UNCHANGED:
            return True
    now, before = new.raised[e], kept.raised[e]
    return bool(now[0] != before[0] or now[1] != before[1] or now[2] != before[2])


@compiled
def passed(row: Row, tables: Tables, begin: int, gamma: Floats, kept: Kept, new: Kept) -> float:
    """Pass the wind through the turbines marked as changed, from ``begin`` downstream.

    Returns
    -------
    How much more power all turbines deliver [W].
    """
    more = 0.0
    slowed, own = np.empty(9), np.empty(3)
    for i in range(begin, len(gamma)):
        if not new.changed[i]:
            continue
        slowed[:], own[:] = 0.0, row.ambient
        for p in range(row.first_in[i], row.first_in[i + 1]):
            e = row.into[p]
            wake = new if new.changed[row.source[e]] else kept
            for q in range(9):
                slowed[q] += wake.squares[e, q]
            for c in range(3):
                own[c] = max(own[c], wake.raised[e, c])
        new.powers[i], C_T = operate(row, tables, i, gamma[i], slowed)
        more += new.powers[i] - kept.powers[i]
        pass_wake(row, i, gamma[i], C_T, own, kept, new)
    return more


@compiled
def keep(row: Row, begin: int, kept: Kept, new: Kept) -> None:
    """Take over what has changed."""
    for i in range(begin, len(row.x)):
        if new.changed[i]:
            kept.powers[i] = new.powers[i]
            for e in range(row.first[i], row.first[i + 1]):
                kept.squares[e] = new.squares[e]
                kept.raised[e] = new.raised[e]
