"""A turbine's power and thrust over the wind speed, as its maker or a reference gives them."""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput

Floats = NDArray[np.float64]

STANDARD_AIR_DENSITY = 1.225
"""Of the standard atmosphere at sea level [kg/m3]: what curves are given at."""

YAW_EXPONENT = 1.88
"""FLORIS's exponent of the cosine by which power falls with the misalignment [-]."""

THRUST_LIMITS = (1e-4, 0.9999)
"""FLORIS keeps thrust coefficients within these: momentum theory ends at 1."""

USUAL_THRUST = 0.8
"""Thrust coefficient of most turbines below their rated wind speed [-]."""

STEP = 0.1
"""Between the tabulated speeds of a stand-in [m/s]: its cubic is met to 1e-4 at 9 m/s."""


@dataclass(frozen=True)
class PowerCurve:
    r"""Power and thrust at tabulated wind speeds, linear between them, nothing outside.

    This is FLORIS's *cosine-loss* turbine on a fixed tower: at a misalignment :math:`\gamma` the
    power is that of the wind speed :math:`(\rho / \rho_0)^{1/3} w \cos^{p/3} \gamma`, and the
    thrust coefficient falls with :math:`\cos\gamma`. The rotor's tilt is part of the tables.

    Parameters
    ----------
    wind_speeds
        Increasing [m/s].
    powers
        At each of them [W].
    thrust_coefficients
        At each of them [-].
    air_density
        Rho_0 at which the powers hold [kg/m3].
    yaw_exponent
        The exponent p of the cosine [-].
    """

    wind_speeds: tuple[float, ...]
    powers: tuple[float, ...]
    thrust_coefficients: tuple[float, ...]
    air_density: float = STANDARD_AIR_DENSITY
    yaw_exponent: float = YAW_EXPONENT

    def __post_init__(self) -> None:
        n = len(self.wind_speeds)
        for field in "powers", "thrust_coefficients":
            if len(getattr(self, field)) != n:
                raise InvalidInput(field, f"to hold {n} numbers", len(getattr(self, field)))
        if n < 2 or not all(low < high for low, high in pairwise(self.wind_speeds)):
            raise InvalidInput("wind_speeds", "to be two or more, increasing", self.wind_speeds)
        for field in "wind_speeds", "powers", "thrust_coefficients":
            values = np.array(getattr(self, field))
            if not (np.isfinite(values).all() and (values >= 0).all()):
                raise InvalidInput(field, ">= 0 and finite", values.min())
        for field in "air_density", "yaw_exponent":
            if not 0 < getattr(self, field) < np.inf:
                raise InvalidInput(field, "> 0 and finite", getattr(self, field))

    @classmethod
    def stand_in(
        cls, C_p: float, swept_area: float, rated_power: float, cut_in: float, cut_out: float
    ) -> "PowerCurve":
        r"""Return a curve for a turbine of which no curve is published.

        Below the rated wind speed it runs at its best :math:`C_p`, with the usual thrust
        coefficient of 0.8. Above, the power stays and the induction a falls as momentum theory
        has it, :math:`C_p \propto a (1 - a)^2` and :math:`C_T = 4 a (1 - a)`. The exponent of
        the cosine is 3: only the wind along the rotor's axis counts.

        Parameters
        ----------
        C_p
            Largest power coefficient [-].
        swept_area
            Area swept by the blades [m2].
        rated_power
            The most the generator may deliver [W].
        cut_in, cut_out
            Wind speeds between which the turbine runs [m/s].
        """
        per_cube = 0.5 * STANDARD_AIR_DENSITY * swept_area * C_p
        w_rated = (rated_power / per_cube) ** (1 / 3)
        steps = np.arange(cut_in, cut_out, STEP)
        inside = [v for v in (w_rated, cut_out) if cut_in < v <= cut_out]
        w = np.unique(np.concatenate([steps, inside]))
        powers = np.minimum(rated_power, per_cube * w**3)
        a_usual = (1 - np.sqrt(1 - USUAL_THRUST)) / 2
        a = np.linspace(0.0, a_usual, 10_001)
        share = a * (1 - a) ** 2 / (a_usual * (1 - a_usual) ** 2)
        a = np.interp(powers / (per_cube * w**3), share, a)
        C_T = 4 * a * (1 - a)
        return cls(tuple(w.tolist()), tuple(powers.tolist()), tuple(C_T.tolist()), yaw_exponent=3.0)

    def scaled(self, factor: float) -> "PowerCurve":
        """Return the curve of a rotor whose area and powers are ``factor`` times as large."""
        return replace(self, powers=tuple(factor * p for p in self.powers))

    def power(self, v: Any) -> Floats:
        """Return the power [W] at wind speeds ``v`` [m/s] already corrected for yaw and density."""
        p: Floats = np.interp(v, self.wind_speeds, self.powers, left=0.0, right=0.0)
        return p

    def thrust(self, v: Any) -> Floats:
        """Return the thrust coefficient [-] of a rotor facing winds ``v`` [m/s]."""
        C_T = np.interp(v, self.wind_speeds, self.thrust_coefficients, left=0.0, right=0.0)
        within: Floats = np.clip(C_T, *THRUST_LIMITS)
        return within

    def most(self, v: float) -> float:
        """Return the largest power [W] at any wind speed up to ``v`` [m/s].

        The curve bends at its tabulated speeds only, so the largest is at one of them or at ``v``.
        """
        below = [p for w, p in zip(self.wind_speeds, self.powers, strict=True) if w <= v]
        return max(0.0, float(self.power(v)), *below)
