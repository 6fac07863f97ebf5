r"""The Gaussian wake of a yawed turbine, smooth enough for a solver.

The model is FLORIS's ``gauss`` with its default constants. Lengths are in rotor diameters of the
turbine that makes the wake, angles in radians, and deficits are fractions of the free wind. With
:math:`\gamma` its misalignment, :math:`C_T` its thrust coefficient, :math:`I` its turbulence
intensity and :math:`k = k_a I + k_b`:

.. math::

    x_0(q) &= \frac{\cos\gamma \, (1 + q)}{\sqrt 2 \,
        (4 \alpha I + 2 \beta (1 - \sqrt{1 - C_T}))}                              \tag{1} \\
    \theta &= -\frac{0.3 \, \gamma}{\cos\gamma} \bigl(1 - \sqrt{1 - C_T \cos\gamma}\bigr) \tag{2} \\
    \delta &= \tan\theta \, \min(\Delta x, x_0) + \frac{\theta E_0}{5.2} \,
        \frac{\sqrt{\hat\sigma_y \hat\sigma_z}}{k \sqrt{C_T}} \,
        \ln \frac{(1.6 + \sqrt{C_T})(s - \sqrt{C_T})}{(1.6 - \sqrt{C_T})(s + \sqrt{C_T})} \tag{3} \\
    d &= \Bigl(1 - \sqrt{1 - \tfrac{C_T \cos\gamma}{8 \sigma_y \sigma_z}}\Bigr)
        \exp\Bigl(-\tfrac{(\Delta y - \delta)^2}{2 \sigma_y^2}
        - \tfrac{\Delta z^2}{2 \sigma_z^2}\Bigr)                                    \tag{4} \\
    I_i^2 &= I_\infty^2 + \bigl(\kappa_{ji} \, a_j^{0.8}\bigr)^2                    \tag{5}

(3) and (4) hold near the rotor and far from it: the widths :math:`\sigma` grow linearly up to
:math:`x_0` and by :math:`k` behind it. The corner there is rounded over :data:`CORNER` diameters,
and that is all in which (1)-(4) differ from FLORIS. In (5) the turbulence of the one source that
disturbs a turbine most is added; :math:`\kappa` holds its distance and by how much of the rotor
its wake covers, which FLORIS counts in ninths.

* Bastankhah & Porté-Agel (2016), Experimental and theoretical study of wind turbine wakes in yawed
  conditions, *J. Fluid Mechanics* 806, 506-541.
* Niayifar & Porté-Agel (2016), Analytical modeling of wind farms: a new approach for power
  prediction, *Energies* 9, 741.
* Crespo & Hernández (1996), Turbulence characteristics in wind-turbine wakes, *J. Wind Engineering
  and Industrial Aerodynamics* 61, 71-85.
"""

from collections.abc import Sequence
from typing import Any

import casadi as ca

ALPHA, BETA = 0.58, 0.077
"""Growth of the near wake by turbulence and by the shear at its edge."""

K_A, K_B = 0.38, 0.004
"""Growth of the far wake by turbulence, and without."""

SIGMA_0 = 8**-0.5
"""Width at the end of the near wake, without yaw [diameters]."""

CORNER = 0.02
"""Over which the end of the near wake is rounded [diameters]."""


def positive(x: Any, corner: float) -> Any:
    """Return max(x, 0), smooth within ``corner`` of 0."""
    return 0.5 * (x + ca.sqrt(x**2 + corner**2))


def near_wake(gamma: Any, C_T: Any, I: Any, q: Any) -> Any:  # noqa: E741
    """Return where the near wake ends, (1)."""
    slowing = 4 * ALPHA * I + 2 * BETA * (1 - ca.sqrt(1 - C_T))
    return ca.cos(gamma) * (1 + q) / (ca.sqrt(2) * slowing)


def deflection(dx: Any, gamma: Any, C_T: Any, I: Any) -> Any:  # noqa: E741
    """Return how far the wake's centre has moved to the left, seen along the wind, (2)-(3)."""
    cos = ca.cos(gamma)
    q = ca.sqrt(1 - C_T * cos)
    x_0 = near_wake(gamma, C_T, I, q)
    far = positive(dx - x_0, CORNER)
    theta = -0.3 * gamma / cos * (1 - q)  # (2)

    u_0 = ca.sqrt(1 - C_T)
    E_0 = (1 - u_0) ** 2 - 3 * ca.exp(1 / 12) * (1 - u_0) + 3 * ca.exp(1 / 3)
    m = ca.sqrt(C_T)
    k = K_A * I + K_B
    sigma_z = 0.5 * ca.sqrt((1 + q) / (2 * (1 + u_0)))
    sigma_y = sigma_z * cos
    s = 1.6 * ca.sqrt((1 + k * far / sigma_y) * (1 + k * far / sigma_z))
    turn = ca.log((1.6 + m) * (s - m) / ((1.6 - m) * (s + m)))
    bend = theta * E_0 / 5.2 * sigma_z * ca.sqrt(cos) / (k * m) * turn
    return ca.tan(theta) * (dx - far) + bend  # (3)


def squared_deficits(
    dx: Any,
    dy: Sequence[Any],
    dz: Sequence[Any],
    gamma: Any,
    C_T: Any,
    I: Any,  # noqa: E741
) -> Any:
    r"""Return :math:`d^2` of (4) at every point (dy, dz) of a rotor downstream.

    Parameters
    ----------
    dx
        Distance downstream of the turbine that makes the wake [its diameters].
    dy, dz
        Columns and rows of points, to the left of its hub and above it [its diameters].
    gamma, C_T, I
        Its misalignment [rad], thrust coefficient and turbulence intensity.

    Returns
    -------
    A vector, row after row.
    """
    cos, u_0 = ca.cos(gamma), ca.sqrt(1 - C_T)
    x_0 = near_wake(gamma, C_T, I, u_0)
    far = positive(dx - x_0, CORNER)
    ramp = (dx - far) / x_0
    start = 0.501 * ca.sqrt(C_T / 2) * (1 - ramp) + (K_A * I + K_B) * far
    sigma_y = start + ramp * SIGMA_0 * cos
    sigma_z = start + ramp * SIGMA_0
    delta = deflection(dx, gamma, C_T, I)
    free = ca.fmax(1 - C_T * cos / (8 * sigma_y * sigma_z), 1e-8)
    centre = (1 - ca.sqrt(free)) ** 2
    across = [centre * ca.exp(-(((y - delta) / sigma_y) ** 2)) for y in dy]
    up = [ca.exp(-((z / sigma_z) ** 2)) for z in dz]
    return ca.vertcat(*(a * u for u in up for a in across))


def axial_induction(gamma: Any, C_T: Any) -> Any:
    """Return the induction a of a yawed rotor, whose C_T holds its loss by the yaw already."""
    cos = ca.cos(gamma)
    return 0.5 / cos * (1 - ca.sqrt(1 - C_T * cos))


def raised_turbulence(ambient: Any, kappa: Any, gamma: Any, C_T: Any) -> Any:
    """Return the turbulence intensity at a turbine by (5), from its main source's yaw and C_T."""
    return ca.sqrt(ambient**2 + (kappa * axial_induction(gamma, C_T) ** 0.8) ** 2)


def added_turbulence(dx: Any, ambient: Any, overlap: Any) -> Any:
    r"""Return :math:`\kappa` of (5) of a source at distance ``dx``.

    ``overlap`` is the share of the rotor downstream that lies in its wake.
    """
    return overlap * 0.5 * ambient**0.1 * dx**-0.32
