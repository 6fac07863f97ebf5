r"""How little and how much a wake can slow the wind, whatever the yaw within a cell.

Interval arithmetic on the exact wake of :mod:`windopt.wakes.gaussian`, over a cell of misalignments
:math:`[\underline\gamma, \overline\gamma]` that does not straddle zero, thrust coefficients
:math:`[\underline C, \overline C]` of the rotor facing the wind, and turbulence intensities
:math:`[\underline I, \overline I]`. Lengths are in rotor diameters. Where a quantity rises or falls
with each of its arguments, which is so for all but the deficit itself, its interval is exact up to
the coupling of its arguments; the deficit's is made narrow by cutting I and C into pieces.
"""

from typing import NamedTuple

import numpy as np

from windopt.solving.exact.compiled import compiled
from windopt.wakes.gaussian import ALPHA, BETA, K_A, K_B

PIECES = 3
"""Into how many pieces the intervals of turbulence and of thrust are cut."""


class Box(NamedTuple):
    """What is known of the turbine that makes a wake."""

    gamma_low: float  # rad, of one sign
    gamma_high: float
    C_low: float
    C_high: float
    I_low: float
    I_high: float


class Spread(NamedTuple):
    """Intervals of a wake at some distance; cosines are those of the yaw."""

    cos_low: float
    cos_high: float
    y_low: float  # widths
    y_high: float
    z_low: float
    z_high: float
    centre_low: float  # of the deficit
    centre_high: float
    delta_low: float  # of the deflection
    delta_high: float


@compiled
def near_wake(cos: float, root: float, u_0: float, turbulence: float) -> float:
    """Return where the near wake ends: rises with all but the turbulence."""
    slowing = 4 * ALPHA * turbulence + 2 * BETA * (1 - u_0)
    x: float = cos * (1 + root) / (np.sqrt(2.0) * slowing)
    return x


@compiled
def between(ramp: float, start: float, end: float) -> float:
    """Return a width in the near wake."""
    return (1 - ramp) * start + ramp * end


@compiled
def widths(
    dx: float, box: Box, cos_low: float, cos_high: float
) -> tuple[float, float, float, float]:
    """Return the intervals of both widths, sigma_y and sigma_z."""
    u_low = np.sqrt(1 - box.C_high * cos_high)
    u_high = np.sqrt(1 - box.C_low * cos_low)
    x_low = near_wake(cos_low, u_low, u_low, box.I_high)
    x_high = near_wake(cos_high, u_high, u_high, box.I_low)
    grown_low = (K_A * box.I_low + K_B) * max(dx - x_high, 0.0)
    grown_high = (K_A * box.I_high + K_B) * max(dx - x_low, 0.0)
    ramp_low, ramp_high = min(dx / x_high, 1.0), min(dx / x_low, 1.0)
    start_low = 0.501 * np.sqrt(box.C_low * cos_low / 2)
    start_high = 0.501 * np.sqrt(box.C_high * cos_high / 2)
    end = 8**-0.5
    y_low = min(
        between(ramp_low, start_low, end * cos_low), between(ramp_high, start_low, end * cos_low)
    )
    y_high = max(
        between(ramp_low, start_high, end * cos_high),
        between(ramp_high, start_high, end * cos_high),
    )
    z_low = min(between(ramp_low, start_low, end), between(ramp_high, start_low, end))
    z_high = max(between(ramp_low, start_high, end), between(ramp_high, start_high, end))
    return y_low + grown_low, y_high + grown_high, z_low + grown_low, z_high + grown_high


@compiled
def bend(g: float, cos: float, sigma_z: float, m: float) -> float:
    """Return the logarithm of the far wake's deflection over m: rises with m and with growth."""
    s = 1.6 * np.sqrt((1 + g / (sigma_z * cos)) * (1 + g / sigma_z))
    turn: float = np.log((1.6 + m) * (s - m) / ((1.6 - m) * (s + m))) / m
    return turn


@compiled
def core(u_0: float) -> float:
    """Return E_0 of the deflection: rises with the wind u_0 in the near wake."""
    C_0 = 1 - u_0
    E_0: float = C_0**2 - 3 * np.exp(1 / 12) * C_0 + 3 * np.exp(1 / 3)
    return E_0


@compiled
def deflections(dx: float, box: Box, cos_low: float, cos_high: float) -> tuple[float, float]:
    """Return the interval of the deflection's size."""
    a, b = abs(box.gamma_low), abs(box.gamma_high)
    q_low, q_high = np.sqrt(1 - box.C_high * cos_high**2), np.sqrt(1 - box.C_low * cos_low**2)
    u_low, u_high = np.sqrt(1 - box.C_high * cos_high), np.sqrt(1 - box.C_low * cos_low)
    theta_low = 0.3 * min(a, b) / cos_high * (1 - q_high)
    theta_high = 0.3 * max(a, b) / cos_low * (1 - q_low)
    x_low = near_wake(cos_low, q_low, u_low, box.I_high)
    x_high = near_wake(cos_high, q_high, u_high, box.I_low)
    k_low, k_high = K_A * box.I_low + K_B, K_A * box.I_high + K_B
    z_low = 0.5 * np.sqrt((1 + q_low) / (2 * (1 + u_high)))
    z_high = 0.5 * np.sqrt((1 + q_high) / (2 * (1 + u_low)))

    m_low, m_high = np.sqrt(box.C_low * cos_low), np.sqrt(box.C_high * cos_high)
    far_low = bend(k_low * max(dx - x_high, 0.0), cos_high, z_high, m_low) / k_high
    far_high = bend(k_high * max(dx - x_low, 0.0), cos_low, z_low, m_high) / k_low
    low = np.tan(theta_low) * min(dx, x_low)
    low += theta_low * core(u_low) / 5.2 * z_low * np.sqrt(cos_low) * max(far_low, 0.0)
    high = np.tan(theta_high) * min(dx, x_high)
    high += theta_high * core(u_high) / 5.2 * z_high * np.sqrt(cos_high) * max(far_high, 0.0)
    return low, high


@compiled
def spread(dx: float, box: Box) -> Spread:
    """Return all intervals of a wake at a distance."""
    a, b = np.cos(box.gamma_low), np.cos(box.gamma_high)
    cos_low, cos_high = min(a, b), max(a, b)
    y_low, y_high, z_low, z_high = widths(dx, box, cos_low, cos_high)
    free_low = 1 - box.C_high * cos_high**2 / (8 * y_low * z_low)
    free_high = 1 - box.C_low * cos_low**2 / (8 * y_high * z_high)
    centre_low = 1 - np.sqrt(min(max(free_high, 0.0), 1.0))
    centre_high = 1 - np.sqrt(min(max(free_low, 0.0), 1.0))
    low, high = deflections(dx, box, cos_low, cos_high)
    if box.gamma_high > 0:  # the wake moves to the other side
        low, high = -high, -low
    wide = y_low, y_high, z_low, z_high
    return Spread(cos_low, cos_high, *wide, centre_low, centre_high, low, high)


@compiled
def sideways(s: Spread, dy: float) -> tuple[float, float]:
    """Return the interval of the deficit at hub height, ``dy`` to the left of the rotor."""
    farthest = max(abs(dy - s.delta_low), abs(dy - s.delta_high)) / s.y_low
    nearest = max(s.delta_low - dy, dy - s.delta_high, 0.0) / s.y_high
    low, high = np.exp(-0.5 * farthest * farthest), np.exp(-0.5 * nearest * nearest)
    return s.centre_low * low, s.centre_high * high


@compiled
def upwards(s: Spread, dz: float) -> tuple[float, float]:
    """Return the interval of the share of it that is left ``dz`` above the hub."""
    low, high = dz / s.z_low, dz / s.z_high
    return np.exp(-0.5 * low * low), np.exp(-0.5 * high * high)


@compiled
def piece(box: Box, i: int, c: int) -> Box:
    """Return one of the pieces of a box."""
    dI, dC = (box.I_high - box.I_low) / PIECES, (box.C_high - box.C_low) / PIECES
    I, C = box.I_low + i * dI, box.C_low + c * dC  # noqa: E741
    return Box(box.gamma_low, box.gamma_high, C, C + dC, I, I + dI)
