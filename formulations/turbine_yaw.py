r"""One turbine's yaw: face the wind as far as it pays, and never exceed the rated power.

The paper's problem (7) chooses the yaw angle for the largest power
:math:`p = \frac12 \rho A (w_s \cos\gamma)^3 C_p` with :math:`0 \le p \le p^{max}`. Here the
tip-speed ratio :math:`\lambda` and the pitch :math:`\beta` are decisions too. Let :math:`v` be
the wind as a multiple of the one in which the turbine just reaches its rated power, :math:`q` the
cube root of the power as a fraction of the rated one, and :math:`r` that of :math:`C_p` as a
fraction of its maximum:

.. math::

    \max_{\gamma, \lambda, \beta, q, r} \quad & \frac{q}{\min(1, v)}
        - \varepsilon (\gamma - \gamma_0)^2                                        \tag{1} \\
    \text{s.t.} \quad & q = v \cos\gamma \; r                                    \tag{2} \\
      & r^3 \, C_{p,max} = C_p(\lambda, \beta)                                     \tag{3} \\
      & 0 \le q \le 1, \quad 0 \le r \le 1                                       \tag{4} \\
      & |\gamma| \le \pi / 2, \quad (\lambda, \beta) \in \Lambda \times B         \tag{5}

What differs from the paper, and why:

- The yaw is its misalignment :math:`\gamma` with the wind, signed and at most a quarter turn, so
  that no search ends at the cut of a circle or behind the rotor, where the cosine is negative.
- Powers appear as cube roots, in (2) and (3): the power itself is flat where it vanishes, and a
  search that comes there believes to have arrived.
- The rotor may give power away by its pitch. With :math:`C_p` held at its best, no yaw that faces
  a wind above the rated one is feasible.
- Above the rated power every yaw within :math:`\arccos(1 / v)` is optimal. The small term in (1)
  chooses the one nearest the nacelle's present :math:`\gamma_0`. Below it the term turns the
  rotor by at most :math:`2 \varepsilon \pi`, at a cost of 6e-9 of the power.

By (2) and (4) no solution has :math:`q > \min(1, v)`: one that reaches it is a global optimum.
Above the rated power :math:`(\lambda, \beta)` is free along a curve;
:func:`formulations.rotor.regulated` gives the point of it at which rotors are run.
"""

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from formulations.rotor import PITCH, TIP_SPEED_RATIO, PowerCoefficient, power

EPSILON = 1e-5
"""Weight of the yaw's travel in (1): small beside the power, large beside a solver's tolerance."""


@dataclass(frozen=True)
class TurbineYaw:
    """The program, its parameters, and what it decides."""

    opti: ca.Opti
    w: ca.MX  # parameter: wind speed [m/s]
    gamma_0: ca.MX  # parameter: present misalignment [rad], in [-pi, pi)
    x: ca.MX  # (5,) gamma [rad], lambda [-], beta [deg], q [-], r [-]
    power: ca.MX  # [W]
    start: NDArray[np.float64]  # (5,) where the search begins


def turbine_yaw(C_p: PowerCoefficient, *, rho: float, A: float, p_rated: float) -> TurbineYaw:
    """Build the program (1)-(5) once, for any wind.

    Parameters
    ----------
    C_p
        Power coefficient of the rotor.
    rho, A
        Air density [kg/m3] and swept area [m2].
    p_rated
        The most the generator may deliver [W].
    """
    best = C_p.best()
    w_rated = (p_rated / power(rho, A, 1.0, 1.0, best.C_p)) ** (1 / 3)

    opti = ca.Opti()
    w = opti.parameter()
    gamma_0 = opti.parameter()
    v = w / w_rated

    x = opti.variable(5)
    gamma, lam, beta, q, r = ca.vertsplit(x)

    opti.minimize(-q / ca.fmin(1, v) + EPSILON * (gamma - gamma_0) ** 2)  # (1)
    opti.subject_to(q == v * ca.cos(gamma) * r)  # (2)
    opti.subject_to(r**3 == C_p(lam, beta) / best.C_p)  # (3)
    opti.subject_to(opti.bounded(0, q, 1))  # (4)
    opti.subject_to(opti.bounded(0, r, 1))
    opti.subject_to(opti.bounded(-np.pi / 2, gamma, np.pi / 2))  # (5)
    opti.subject_to(opti.bounded(TIP_SPEED_RATIO[0], lam, TIP_SPEED_RATIO[1]))
    opti.subject_to(opti.bounded(PITCH[0], beta, PITCH[1]))

    start = np.array([0.0, best.lam, 10.0, 0.5, 0.5])
    opti.set_initial(x, start)
    return TurbineYaw(opti, w, gamma_0, x, p_rated * q**3, start)
