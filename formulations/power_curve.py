"""A turbine's power and thrust over the wind speed: straight pieces with rounded corners.

Tables are read as FLORIS reads them, linearly; a spline through the same points would differ by a
percent. Their corners would stop a search that needs two derivatives, so each is replaced by a
parabola over a few centimetres per second, which touches both of its pieces.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

CORNER = 0.035
"""Half the width over which corners are rounded [m/s]: where the slope changes by s, a value is off
by s times a quarter of this."""

THRUST = (1e-4, 0.9999)
"""Thrust coefficients are kept within these: momentum theory ends at 1."""

START = 0.1
"""Over which power and thrust rise to the first values of a table [m/s]."""


class Curve(NamedTuple):
    """Power [W] and thrust coefficient over the wind speed [m/s], linear in between."""

    speeds: tuple[float, ...]
    powers: tuple[float, ...]
    thrusts: tuple[float, ...]
    yaw_exponent: float  # of the cosine by which the power falls
    air_density: float  # at which the powers hold [kg/m3]

    def upto(self, v: float) -> "Curve":
        """Return the part of the curve that winds up to ``v`` reach, zero below its start."""
        start = self.speeds[0]
        zeros = [u for u in (start - 2, start - START) if start > 0]
        speeds = (*zeros, *self.speeds)
        powers = (*(0.0 for _ in zeros), *self.powers)
        C_T = (*(0.0 for _ in zeros), *self.thrusts)
        thrusts = tuple(float(c) for c in np.clip(C_T, *THRUST))
        m = min(len(speeds), max(2, 2 + sum(u < v for u in speeds)))
        return self._replace(speeds=speeds[:m], powers=powers[:m], thrusts=thrusts[:m])

    def rising(self) -> "Curve":
        """Return the curve up to the rated power, or all of it where the power falls again."""
        top = self.powers.index(max(self.powers))
        m = max(2, top + 1) if min(self.powers[top:]) == self.powers[top] else len(self.speeds)
        return self._replace(
            speeds=self.speeds[:m], powers=self.powers[:m], thrusts=self.thrusts[:m]
        )


def linear_pieces(v: Any, at: Sequence[float], values: Sequence[float], blend: float) -> Any:
    """Return the line through tabulated values, its corners rounded by parabolas.

    Parameters
    ----------
    v
        Where; beyond the table its first and last pieces go on.
    at, values
        The table.
    blend
        Half the width of a corner.
    """
    slopes = [
        (b - a) / (w - u)
        for u, w, a, b in zip(at[:-1], at[1:], values[:-1], values[1:], strict=True)
    ]
    line = values[0] + slopes[0] * (v - at[0])
    for corner, before, after in zip(at[1:-1], slopes[:-1], slopes[1:], strict=True):
        if after != before:
            x = v - corner
            inside = ca.fmin(ca.fmax(x, -blend), blend)
            line += (after - before) * ((inside + blend) ** 2 / (4 * blend) + ca.fmax(x - blend, 0))
    return line
