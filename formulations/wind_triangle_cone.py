r"""The wind triangle as a second-order cone program, to prove the closed form.

For legs :math:`l` with directions :math:`e_l` of length one, all at once because they share
nothing:

.. math::

    \max_s \quad & \sum_l s_l                                                     \tag{1} \\
    \text{s.t.} \quad & \lVert s_l e_l - w \rVert \le u_{\max}                    \tag{2} \\
                      & 0 \le s_l \le u_{\max}                                    \tag{3}

An experimenter who limits the UAV in another way, by power or by climb, changes a row here;
:mod:`formulations.wind_triangle` is the closed form of these ones, without a solver.
"""

from dataclasses import dataclass

import cvxpy as cp
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class WindTriangleCone:
    """The program (1)-(3), infeasible if any of its legs cannot be flown."""

    problem: cp.Problem
    s: cp.Variable  # (legs,) ground speed [m/s]


def wind_triangle_cone(
    d: NDArray[np.float64], w: NDArray[np.float64], u_max: float, *, cap: bool = True
) -> WindTriangleCone:
    """Build the program (1)-(3).

    Parameters
    ----------
    d
        Displacements [m], shape ``(legs, 2)``, none of length 0.
    w
        Velocity of the air [m/s], shape ``(2,)``.
    u_max
        Greatest airspeed [m/s].
    cap
        Whether ``u_max`` limits the ground speed too.
    """
    e = d / np.hypot(d[:, 0], d[:, 1])[:, None]

    s = cp.Variable(len(d), nonneg=True)

    v = cp.multiply(s[:, None], e) - w[None, :]
    rows = [cp.norm(v, axis=1) <= u_max]  # (2)
    if cap:
        rows.append(s <= u_max)  # (3)

    return WindTriangleCone(cp.Problem(cp.Maximize(cp.sum(s)), rows), s)  # (1)
