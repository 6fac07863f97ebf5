"""A farm in its winds, in numbers: what :mod:`formulations.farm_yaw` is built for."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from formulations.power_curve import Curve

Floats = NDArray[np.float64]
Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class FarmInWind:
    """n turbines in K winds that belong to T steps, each with its own misalignments.

    Parameters
    ----------
    turbines
        Easting and northing [m], shape ``(n, 2)``.
    D, H
        Rotor diameters and hub heights [m], shape ``(n,)``.
    curves, curve_of
        The distinct power curves, and which of them each turbine has.
    speeds, directions
        Of the winds [m/s], [rad, from where, clockwise from north], shape ``(K,)``.
    weights
        Of the winds in the objective, shape ``(K,)``.
    steps
        The step to which each wind belongs, shape ``(K,)``.
    turbulence
        Ambient intensity [-].
    air_density
        [kg/m3].
    shear, reference_height
        The wind at height z is that at the reference height [m] times (z / z_ref)^shear.
    """

    turbines: Floats
    D: Floats
    H: Floats
    curves: Sequence[Curve]
    curve_of: Places
    speeds: Floats
    directions: Floats
    weights: Floats
    steps: Places
    turbulence: float
    air_density: float = 1.225
    shear: float = 0.12
    reference_height: float = 90.0

    @property
    def rows(self) -> Floats:
        """Rows of points on a rotor [diameters above its hub].

        Where all turbines are as high and wide, the lower row feels the same deficit as the upper.
        """
        alike = np.ptp(self.D) == 0 and np.ptp(self.H) == 0
        return np.array([0.0, 0.25] if alike else [0.0, 0.25, -0.25])

    @property
    def rated_powers(self) -> Floats:
        """The most that each turbine delivers [W], shape ``(n,)``."""
        rated: Floats = np.array([max(curve.powers) for curve in self.curves])[self.curve_of]
        return rated

    def shares(self) -> Floats:
        """Return the weight of every point in a rotor's mean cube of the wind, shape ``(P, n)``."""
        rows = np.array([0.0, 0.25, -0.25])
        heights = self.H + rows[:, None] * self.D
        cubes = (heights / self.reference_height) ** (3 * self.shear) / 9
        if len(self.rows) == 2:
            cubes = np.array([cubes[0], cubes[1] + cubes[2]])
        return np.repeat(cubes, 3, axis=0)

    def free(self) -> Floats:
        """Return the cubic mean of the undisturbed wind over each rotor [wind speeds]."""
        mean: Floats = np.cbrt(self.shares().sum(axis=0))
        return mean

    def free_power(self) -> float:
        """Return the mean power of the farm without wakes [W]."""
        facing = np.zeros((len(self.speeds), len(self.turbines)))
        return float(
            self.powers(np.broadcast_to(self.free(), facing.shape), facing).sum() / len(self.speeds)
        )

    def powers(self, U: Floats, gamma: Floats) -> Floats:
        """Return the power of every turbine in winds U [wind speeds] at misalignments [rad]."""
        powers = np.zeros_like(U)
        for c in range(len(self.curves)):
            curve, of = self.curve(c), self.curve_of == c
            v = (self.air_density / curve.air_density) ** (1 / 3) * self.speeds[:, None] * U[:, of]
            v = v * np.cos(gamma[:, of]) ** (curve.yaw_exponent / 3)
            powers[:, of] = np.interp(v, curve.speeds, curve.powers)
        return powers

    def curve(self, c: int) -> Curve:
        """Return the part of a curve that the winds reach."""
        density = (self.air_density / self.curves[c].air_density) ** (1 / 3)
        reach = max(1.0, density) * float(self.free().max()) * float(self.speeds.max())
        return self.curves[c].upto(float(np.ceil(reach)))

    def thrusts(self, U: Floats) -> Floats:
        """Return the thrust coefficients of rotors that face winds U [wind speeds]."""
        C_T = np.zeros_like(U)
        v = self.speeds[:, None] * U
        for c in range(len(self.curves)):
            curve, of = self.curve(c), self.curve_of == c
            C_T[:, of] = np.interp(v[:, of], curve.speeds, curve.thrusts)
        return C_T
