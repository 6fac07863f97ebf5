r"""The flying range of each UAV under wind, as the paper draws it.

Around station i lies the circle :math:`B_i` of the radius :math:`\rho_i`, the distance that its UAV
flies. The wind moves the circle by :math:`w\,t_i^{\max}`, and a UAV keeps to the part that both
circles share:

.. math::

    Z_i = \{q : \lVert q - q_i \rVert \le \rho_i\} \cap
          \{q : \lVert q - q_i - w\,t_i^{\max} \rVert \le \rho_i\}

Seen from the station, :math:`Z_i` ends :math:`\rho_i - \lVert w \rVert t_i^{\max}` upwind, so a
radius that would be natural in still air, out and back at :math:`u_i^{\max}`, can leave out the
station itself: with :math:`t^{\max}` = 18 min, 10 m/s of wind move the circle by 10.8 km, and half
of what 16 m/s cover is 8.6 km.

The paper leaves :math:`\rho_i` to the operator and calls it the distance that the UAV flies. Unless
given it is :math:`u_i^{\max} t_i^{\max}` here, all that one battery flies in still air, and then
:math:`Z_i` holds every turbine from which the UAV can return: after :math:`\tau` seconds it is
within :math:`u \tau` of a point that drifts with the wind, so within
:math:`u \tau + \lVert w \rVert (t^{\max} - \tau) \le u\,t^{\max}` of where that point ends. Only
turbines out of reach are given away.

A smaller radius gives away turbines upwind that the UAV could inspect, as in the paper's example;
:math:`(u^{\max} + \lVert w \rVert)\,t^{\max} / 2` ends the range upwind where half a flight does.
That rarely pays: what the way out loses to the wind the way back makes up for, and the UAV that
takes over is usually farther away.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from windopt.domain.routing import RoutingInstance
from windopt.errors import InvalidInput


def flying_range(instance: RoutingInstance, radius: ArrayLike | None = None) -> NDArray[np.bool_]:
    """Return whether turbine k stands in the flying range Z of UAV i, shape ``(k, n)``.

    Parameters
    ----------
    radius
        Rho [m], one for all or one for each station; airspeed times ``t_max`` unless given.

    Raises
    ------
    InvalidInput
        If a radius is negative or missing, or there are others than one or one for each station.
    """
    rho = np.asarray(instance.airspeed * instance.t_max if radius is None else radius, dtype=float)
    if not (rho >= 0.0).all():
        raise InvalidInput("flying range", ">= 0 m", radius)
    k = len(instance.stations)
    if rho.shape not in ((), (1,), (k,)):
        raise InvalidInput("flying range", f"to be one radius or {k}", f"shape {rho.shape}")
    shift = instance.w * instance.t_max[:, None]
    return _circle(instance, instance.stations, rho) & _circle(
        instance, instance.stations + shift, rho
    )


def _circle(
    instance: RoutingInstance, centre: NDArray[np.float64], rho: NDArray[np.float64]
) -> NDArray[np.bool_]:
    d = instance.turbines - centre[:, None]
    return np.hypot(d[..., 0], d[..., 1]) <= np.broadcast_to(rho, len(centre))[:, None]
