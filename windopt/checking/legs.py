r"""How long a leg takes, derived anew.

Where the planner asks for the fastest ground speed along a leg, the checker asks for the least
time T in which the leg :math:`d` can be flown. The UAV's own velocity is :math:`d / T - w`, so
the limit on its airspeed reads

.. math:: (w^2 - u_{\max}^2)\, T^2 - 2\,(d \cdot w)\, T + d^2 \le 0,

a quadratic in T, and a cap on the ground speed asks for :math:`T \ge \|d\| / u_{\max}`.
"""

from math import acos, asin, cos, hypot, inf, pi, sin, sqrt

from windopt.domain.fleet import Uav
from windopt.domain.wind import Wind

Displacement = tuple[float, float]

ABEAM = 1e-8
"""Radians; the paper's rule jumps where the wind is abeam, and rounding must not decide."""

CARRIED_OFF = 1e6
"""Airspeeds of wind beyond which no leg is flown, and squares would not fit into a float."""


def least_time(d: Displacement, wind: Wind, uav: Uav) -> float:
    """Return the least time of a leg [s]; ``inf`` where the UAV cannot hold the course."""
    length = hypot(*d)
    if length == 0:
        return 0.0
    first, last = _times_within_airspeed(d, wind, uav.airspeed)
    earliest = max(first, length / uav.airspeed) if uav.ground_speed_cap else first
    return earliest if earliest <= last else inf


def _times_within_airspeed(d: Displacement, wind: Wind, u_max: float) -> tuple[float, float]:
    """Return the first and last T that solve the quadratic; ``(inf, 0)`` where none does."""
    length = hypot(*d)
    if wind.speed > CARRIED_OFF * u_max:
        return inf, 0.0
    # Scaled to O(1): times in still-air times of the leg, speeds in airspeeds.
    along = (d[0] * wind.u + d[1] * wind.v) / (length * u_max)
    a = (wind.speed / u_max) ** 2 - 1
    discriminant = along**2 - a
    if discriminant < 0 or (a >= 0 and along <= 0):
        return inf, 0.0
    # The product of the roots is 1 / a, so that neither is a difference of like numbers.
    root = sqrt(discriminant)
    still_air = length / u_max
    if a < 0:
        first = (root - along) / -a if along < 0 else 1 / (along + root)
        return first * still_air, inf
    first = 1 / (along + root)
    return first * still_air, ((along + root) / a * still_air if a > 0 else inf)


def time_by_the_papers_rule(d: Displacement, wind: Wind, uav: Uav) -> float:
    """Return the time of a leg [s] by the paper's rule: full ground speed in any tail wind."""
    length = hypot(*d)
    if length == 0:
        return 0.0
    if wind.speed == 0:
        return length / uav.airspeed
    cosine = (d[0] * wind.u + d[1] * wind.v) / (length * wind.speed)
    theta_sw = acos(max(-1.0, min(1.0, cosine)))
    if theta_sw <= pi / 2 + ABEAM:
        return length / uav.airspeed
    drift = wind.speed * sin(pi - theta_sw) / uav.airspeed
    if drift > 1:
        return inf
    speed = uav.airspeed * cos(asin(drift)) - wind.speed * cos(pi - theta_sw)
    return length / speed if speed > 0 else inf


def airspeed(d: Displacement, time: float, wind: Wind) -> float:
    """Return the airspeed [m/s] that covers the leg in ``time`` [s]."""
    return hypot(d[0] / time - wind.u, d[1] / time - wind.v)
