r"""The paper's Algorithm 1: face the wind unless that would exceed the rated power.

As it reads: obtain C_p, compute :math:`p = \frac12 \rho A w_s^3 C_p` (the paper's eq. 1), then

.. math::

    \theta^{yaw} \leftarrow \begin{cases}
        \theta_w^{pol} & p \le p^{max} \\
        \theta^{yaw}   & p > p^{max}
    \end{cases}

Two things can go wrong above the rated wind, where the old yaw is kept:

- it may be turned so far away that the turbine delivers less than its rated power, wasting the
  difference, or nothing at all;
- it may not be turned far enough, and without pitch control, which the paper leaves out, the
  turbine would exceed the rated power that the rule was made to keep.

Set-points carry the pitch of a real turbine, so they keep the rated power in the second case too;
:func:`exceeds_rated` tells whether the rule alone would not have.
"""

from math import cos, inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from formulations.rotor import OperatingPoint, PowerCoefficient, operating_point, power
from windopt.domain.yaw_problem import YawProblem
from windopt.result import Result, Status
from windopt.wakes.farm import farm_power


def algorithm_1(
    C_p: PowerCoefficient, gamma_0: float, *, w: float, rho: float, A: float, p_rated: float
) -> OperatingPoint:
    """Return the paper's set-point of one turbine.

    Parameters
    ----------
    C_p
        Power coefficient of its rotor.
    gamma_0
        Present misalignment with the wind [rad].
    w
        Wind speed [m/s].
    rho, A
        Air density [kg/m3] and swept area [m2].
    p_rated
        The most the generator may deliver [W].
    """
    turbine = {"w": w, "rho": rho, "A": A, "p_rated": p_rated}
    gamma = gamma_0 if exceeds_rated(C_p, 0.0, **turbine) else 0.0
    return operating_point(C_p, gamma, **turbine)


def exceeds_rated(
    C_p: PowerCoefficient, gamma: float, *, w: float, rho: float, A: float, p_rated: float
) -> bool:
    """Whether a turbine of this yaw would exceed its rated power without pitch control.

    The parameters are those of :func:`algorithm_1`, with ``gamma`` the yaw kept [rad].
    """
    return bool(power(rho, A, w, max(0.0, cos(gamma)), C_p.best().C_p) > p_rated)


def face_or_hold(
    problem: YawProblem, *, time_limit: float = inf, seed: int = 0
) -> Result[NDArray[np.float64]]:
    """Follow the paper's rule in a farm: it looks at the free wind and knows of no wakes.

    A turbine holds its present misalignment, as far as its bounds let it, where the free wind would
    let it deliver its rated power or more, and faces the wind elsewhere.

    Parameters
    ----------
    problem
        The farm and its winds; where there are several, their mean unwaked power decides.
    time_limit, seed
        Not needed: the rule takes no time and draws nothing.
    """
    begin = perf_counter()
    rated = np.array([max(curve.powers) for curve in problem.curves])[problem.curve_of]
    present = np.zeros(len(problem)) if problem.present is None else problem.present
    hold = problem.weights @ problem.unwaked >= rated
    gamma = np.clip(np.where(hold, present, 0.0), problem.lower, problem.upper)
    power = float(farm_power(problem, gamma))
    return Result(Status.FEASIBLE, gamma, power, problem.bound, perf_counter() - begin)
