r"""The wind triangle: how fast, and therefore how long, a UAV flies a leg through moving air.

Velocity over ground is velocity through the air plus the wind, :math:`s\,e = v + w`, along
the leg's direction :math:`e`. With airspeed and ground speed both at most :math:`u_{\max}`,
the fastest way to fly the leg is

.. math::

    \max\ & s                                                                  \tag{1} \\
    \text{s.t.}\ & \lVert s\,e - w \rVert \le u_{\max}                         \tag{2} \\
                 & s \le u_{\max}                                              \tag{3}

Across the leg the UAV must cancel :math:`w \times e`, which leaves
:math:`\sqrt{u_{\max}^2 - (w \times e)^2}` of its airspeed along it, so (2) holds exactly for

.. math::

    w \cdot e - \sqrt{u_{\max}^2 - (w \times e)^2} \le s \le
    w \cdot e + \sqrt{u_{\max}^2 - (w \times e)^2}                             \tag{4}

and the answer is the upper end or :math:`u_{\max}`, whichever is less. The leg cannot be flown
where :math:`|w \times e| > u_{\max}`, where the upper end is not positive (the wind carries the
UAV backwards), or where the lower end exceeds :math:`u_{\max}` (it is carried too fast).

Flight times obey the triangle inequality: the velocities over ground that (2) and (3) allow form
a convex set :math:`Z`, and the time of a displacement :math:`d` is the least :math:`\tau` with
:math:`d \in \tau Z`, the gauge of :math:`Z`. If :math:`a \in \tau_a Z` and
:math:`b \in \tau_b Z`, then :math:`a + b \in (\tau_a + \tau_b) Z` because :math:`Z` is convex, so
going straight never takes longer than a detour. The rule of :func:`ground_speed_paper`
promises no such thing.
"""

import numpy as np
from numpy.typing import NDArray

STANDSTILL = 1e-9  # Fractions of u_max that are rounding, not motion.


def ground_speed(
    d: NDArray[np.float64], w: NDArray[np.float64], u_max: float, *, cap: bool = True
) -> NDArray[np.float64]:
    """Return the greatest ground speed along each leg [m/s], 0 where it cannot be flown.

    Parameters
    ----------
    d
        Displacements [m], shape ``(..., 2)``.
    w
        Velocity of the air [m/s], shape ``(2,)``.
    u_max
        Greatest airspeed [m/s].
    cap
        Whether ``u_max`` limits the ground speed too, as the paper's (8h) asks; without it the
        UAV rides a tail wind.
    """
    along, across = _components(d, w)
    reserve = np.sqrt(np.maximum(u_max**2 - across**2, 0.0))
    slowest, fastest = along - reserve, along + reserve
    flown = (np.abs(across) <= u_max) & (fastest > STANDSTILL * u_max)
    if cap:
        flown &= slowest <= u_max
        fastest = np.minimum(fastest, u_max)
    return np.where(flown, fastest, 0.0)


def ground_speed_paper(
    d: NDArray[np.float64], w: NDArray[np.float64], u_max: float
) -> NDArray[np.float64]:
    """Return the ground speed along each leg by the paper's rule [m/s], 0 where it has none.

    With the wind anywhere behind, ``u_max``; with the wind ahead, the upper end of (4). In a wind
    from behind but near the beam, ``u_max`` over ground needs a greater airspeed than ``u_max``.
    The rule jumps where the wind is abeam, which counts as behind.

    Parameters
    ----------
    d
        Displacements [m], shape ``(..., 2)``.
    w
        Velocity of the air [m/s], shape ``(2,)``.
    u_max
        Greatest airspeed [m/s].
    """
    along, across = _components(d, w)
    head = along + np.sqrt(np.maximum(u_max**2 - across**2, 0.0))
    head = np.where((np.abs(across) <= u_max) & (head > STANDSTILL * u_max), head, 0.0)
    return np.where(along >= -STANDSTILL * u_max, u_max, head)


def flight_time(d: NDArray[np.float64], speed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the time to fly each leg [s]: 0 where it has no length, ``inf`` where no speed.

    Parameters
    ----------
    d
        Displacements [m], shape ``(..., 2)``.
    speed
        Ground speed along each [m/s], shape ``(...)``.
    """
    distance = np.hypot(d[..., 0], d[..., 1])
    time = np.full(distance.shape, np.inf)
    np.divide(distance, speed, out=time, where=speed > 0.0)
    return np.where(distance > 0.0, time, 0.0)


def _components(
    d: NDArray[np.float64], w: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the wind along and across each leg [m/s]; a leg of no length feels neither."""
    distance = np.hypot(d[..., 0], d[..., 1])
    e = d / np.where(distance > 0.0, distance, 1.0)[..., None]
    return e @ w, w[0] * e[..., 1] - w[1] * e[..., 0]
