r"""What a rotor makes of the wind: power coefficients and power.

The paper names :math:`C_p(\lambda, \beta)` without giving it. Four published models stand here,
members of one family,

.. math::

    C_p(\lambda, \beta) &= c_1 \Bigl(\frac{c_2}{\lambda_i} - c_3 \beta - c_4 \beta^x
        - c_5\Bigr) e^{-c_6 / \lambda_i} + c_7 \lambda,                          \tag{1} \\
    \frac{1}{\lambda_i} &= \frac{1}{\lambda + c_8 \beta} - \frac{c_9}{\beta^3 + 1}  \tag{2}

with :math:`\lambda` the tip-speed ratio and :math:`\beta` the blade pitch in degrees, as in the
sources (the paper's own text swaps the two names). Both are kept inside a box, 1 to 15 and 0 to
30 degrees: below it :math:`\lambda + c_8 \beta` meets zero, and (2) has a pole at
:math:`\beta = -1`. Inside it every model is smooth and has a single hump. A negative :math:`C_p` is
returned as it is: such a rotor would have to be driven.

- *slootweg*: Slootweg, de Haan, Polinder & Kling (2003), General model for representing variable
  speed wind turbines in power system dynamics simulations, *IEEE Trans. Power Systems* 18, 144-151;
- *heier*: Heier (2006), *Grid Integration of Wind Energy Conversion Systems*, 2nd ed., Wiley;
- *mathworks*: MathWorks, *Wind Turbine* block, Simscape Electrical, Specialized Power Systems;
- *dai*: Dai, Liu, Wen & Long (2016), Research on power coefficient of wind turbines based on SCADA
  data, *Renewable Energy* 86, 206-215.
"""

from dataclasses import dataclass
from functools import cache
from math import cos, e
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

TIP_SPEED_RATIO = (1.0, 15.0)
"""Tip-speed ratios for which the models are used [-]."""

PITCH = (0.0, 30.0)
"""Blade pitches for which the models are used [deg]."""


class Best(NamedTuple):
    """The largest power coefficient of a model, and where it is reached."""

    C_p: float  # [-]
    lam: float  # [-]
    beta: float  # [deg]


class OperatingPoint(NamedTuple):
    """How a turbine stands and turns, and what it delivers."""

    gamma: float  # misalignment of the rotor with the wind [rad]
    lam: float  # tip-speed ratio [-]
    beta: float  # blade pitch [deg]
    power: float  # [W]


@dataclass(frozen=True)
class PowerCoefficient:
    """One model of the family (1)-(2), by its constants."""

    c1: float
    c2: float
    c3: float
    c4: float
    x: float
    c5: float
    c6: float
    c7: float
    c8: float
    c9: float

    def __call__(self, lam: Any, beta: Any) -> Any:
        """Return C_p on floats, arrays or CasADi symbols.

        Parameters
        ----------
        lam
            Tip-speed ratio [-].
        beta
            Blade pitch [deg].
        """
        inverse = 1 / (lam + self.c8 * beta) - self.c9 / (beta**3 + 1)  # (2)
        lift = self.c2 * inverse - self.c3 * beta - self.c4 * beta**self.x - self.c5
        return self.c1 * lift * e ** (-self.c6 * inverse) + self.c7 * lam  # (1)

    def best(self) -> Best:
        """Return the largest C_p inside the box: the bound that certifies every set-point."""
        return _best(self)


MODELS: dict[str, PowerCoefficient] = {
    "slootweg": PowerCoefficient(0.73, 151, 0.58, 0.002, 2.14, 13.2, 18.4, 0, -0.02, 0.003),
    "heier": PowerCoefficient(0.5, 116, 0.4, 0, 1, 5, 21, 0, 0.089, 0.035),
    "mathworks": PowerCoefficient(0.5176, 116, 0.4, 0, 1, 5, 21, 0.0068, 0.08, 0.035),
    "dai": PowerCoefficient(0.22, 120, 0.4, 0, 1, 5, 12.5, 0, 0.08, 0.035),
}
"""The published models, by name."""


@cache
def _best(model: PowerCoefficient) -> Best:
    """Zoom into the best cell of a grid that is too dense to miss a model's one hump."""
    low, high = lowest, highest = np.array([TIP_SPEED_RATIO, PITCH]).T
    cells = 280
    while True:
        lam, beta = np.linspace(low, high, cells + 1).T
        C_p = model(lam[:, None], beta)
        i, j = np.unravel_index(C_p.argmax(), C_p.shape)
        cell = (high - low) / cells
        if cell.max() < 1e-11:  # a step this short changes C_p by less than rounding does
            return Best(float(C_p[i, j]), float(lam[i]), float(beta[j]))
        peak = np.array([lam[i], beta[j]])
        low, high = np.maximum(lowest, peak - 2 * cell), np.minimum(highest, peak + 2 * cell)


def power(rho: Any, A: Any, w: Any, c: Any, C_p: Any) -> Any:
    r"""Return the power of a rotor [W]: :math:`\frac12 \rho A (w c)^3 C_p` (the paper's eq. 1).

    Parameters
    ----------
    rho, A
        Air density [kg/m3] and swept area [m2].
    w
        Wind speed [m/s].
    c
        Cosine of the misalignment: only the wind along the rotor's axis counts.
    C_p
        Power coefficient [-].
    """
    return 0.5 * rho * A * (w * c) ** 3 * C_p


def regulated(model: PowerCoefficient, v: float) -> tuple[float, float]:
    """Return the tip-speed ratio and pitch [deg] that hold a rotor at its rated power.

    It keeps the speed at which it reaches rated power and pitches its blades; where no pitch
    in the box is enough, it turns as much faster as it must.

    Parameters
    ----------
    model
        Its power coefficient.
    v
        Wind along its axis, as a multiple (at least 1) of the wind that just suffices.
    """
    C_p_max, lam_best, beta_best = model.best()
    lam, wanted = lam_best / v, C_p_max / v**3

    def excess(lam: float, beta: float) -> float:
        return float(model(lam, beta)) - wanted

    if excess(lam, beta_best) < 0:
        return brentq(excess, lam, lam_best, args=(beta_best,)), beta_best
    if excess(lam, PITCH[1]) > 0:
        return brentq(excess, lam, lam_best, args=(PITCH[1],)), PITCH[1]
    return lam, brentq(lambda beta: excess(lam, beta), beta_best, PITCH[1])


def operating_point(
    model: PowerCoefficient, gamma: float, *, w: float, rho: float, A: float, p_rated: float
) -> OperatingPoint:
    """Return what a turbine with this yaw delivers: all it can, or its rated power.

    Parameters
    ----------
    model
        Power coefficient of its rotor.
    gamma
        Misalignment with the wind [rad]; a rotor that is turned away delivers nothing.
    w
        Wind speed [m/s].
    rho, A
        Air density [kg/m3] and swept area [m2].
    p_rated
        The most the generator may deliver [W].
    """
    best = model.best()
    available = power(rho, A, w, max(0.0, cos(gamma)), best.C_p)
    if available <= p_rated:
        return OperatingPoint(gamma, best.lam, best.beta, available)
    lam, beta = regulated(model, (available / p_rated) ** (1 / 3))
    return OperatingPoint(gamma, lam, beta, p_rated)
