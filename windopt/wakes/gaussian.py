r"""The wake of one turbine: how much slower, how far aside, how much rougher.

FLORIS 4's models by their names there, with the constants of its default input:

- velocity ``gauss`` (Bastankhah & Porté-Agel 2014, 2016; Niayifar & Porté-Agel 2016),
- deflection ``gauss`` (Bastankhah & Porté-Agel 2016), without the curl's secondary steering,
- turbulence ``crespo_hernandez`` (Crespo & Hernández 1996).

They agree with FLORIS to rounding, its peculiarities included: the near wake of the velocity ends
elsewhere than that of the deflection, and turbulence is added by the share of rotor points whose
wind is slowed by more than 0.05 m/s.

Arrays have the axes ``(B, S, m, c)``: B sets of misalignments, S winds, m turbines downstream and c
columns of rotor points, where c = 1 stands for equal columns.

* Bastankhah & Porté-Agel (2016), Experimental and theoretical study of wind turbine wakes in yawed
  conditions, *J. Fluid Mechanics* 806, 506-541.
* Crespo & Hernández (1996), Turbulence characteristics in wind-turbine wakes, *J. Wind Engineering
  and Industrial Aerodynamics* 61, 71-85.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

ALPHA, BETA = 0.58, 0.077  # length of the near wake
K_A, K_B = 0.38, 0.004  # growth of the wake with turbulence
CLOSE = 0.1  # m: nearer than this a turbine is not downstream


@dataclass(frozen=True)
class Rotor:
    """The turbine that makes the wake.

    Parameters
    ----------
    D
        Rotor diameter [m], shape ``(S, 1, 1)``.
    gamma
        Misalignment [rad], shape ``(B, S, 1, 1)``.
    C_T
        Thrust coefficient, its loss by the misalignment included [-], same shape.
    I
        Turbulence intensity [-], shape ``(B, S, 1, c)``.
    """

    D: Floats
    gamma: Floats
    C_T: Floats
    I: Floats  # noqa: E741  (the literature's name of turbulence intensity)

    @property
    def k(self) -> Floats:
        """Growth of the wake's width per distance [-]."""
        return K_A * self.I + K_B

    @property
    def cos(self) -> Floats:
        """Cosine of the misalignment."""
        return np.cos(self.gamma)

    def near_wake(self, root: Floats) -> Floats:
        """Length of the near wake [m], by ``root`` = sqrt(1 - C_T) or sqrt(1 - C_T cos)."""
        slowing = 4 * ALPHA * self.I + 2 * BETA * (1 - np.sqrt(1 - self.C_T))
        length: Floats = self.D * self.cos * (1 + root) / (np.sqrt(2) * slowing)
        return length


def deflection(rotor: Rotor, dx: Floats) -> Floats:
    """Return how far the wake's centre has moved aside [m] at distances ``dx`` [m] downstream.

    Positive to the left, seen along the wind; shape ``(B, S, m, c)``.
    """
    cos, C_T, k = rotor.cos, rotor.C_T, rotor.k
    root = np.sqrt(1 - C_T * cos)
    x0 = rotor.near_wake(root)
    theta = -0.3 * rotor.gamma / cos * (1 - root)
    delta0 = np.tan(theta) * x0

    u0 = np.sqrt(1 - C_T)
    sigma_z0 = rotor.D / 2 * np.sqrt(C_T * cos / (2 * (1 - root)) / (1 + u0))
    sigma_y0 = sigma_z0 * cos
    C0 = 1 - u0
    E0 = C0**2 - 3 * np.exp(1 / 12) * C0 + 3 * np.exp(1 / 3)
    m = np.sqrt(C0 * (2 - C0))
    turn = theta * E0 / 5.2 * np.sqrt(sigma_y0 * sigma_z0) / (k * m)

    growth = k * np.maximum(dx - x0, 0.0)
    width = 1.6 * np.sqrt((growth + sigma_y0) * (growth + sigma_z0) / (sigma_y0 * sigma_z0))
    ratio = (1.6 + m) * (width - m) / ((1.6 - m) * (width + m))
    far = dx > x0
    moved: Floats = np.where(far, delta0 + turn * np.log(ratio), dx / x0 * delta0)
    return moved


def deficit(rotor: Rotor, dx: Floats, dy: Floats, dz: Floats) -> Floats:
    """Return the fraction by which the wake slows the wind at points of the rotors downstream.

    Parameters
    ----------
    rotor
        The turbine that makes the wake.
    dx
        Distance downstream [m], shape ``(S, m, 1)``.
    dy
        Distance to the left of the turbine [m], shape ``(S, m, 3)``.
    dz
        Height above its hub [m], shape ``(S, m, 1, 3)``.

    Returns
    -------
    Shape ``(B, S, m, 3, 3)``: the columns of points from right to left, each from below upwards.
    """
    D, cos, C_T = rotor.D, rotor.cos, rotor.C_T
    x0 = rotor.near_wake(np.sqrt(1 - C_T))
    sigma_0 = D / np.sqrt(8)
    growth = rotor.k * (dx - x0)
    sigma_y, sigma_z = growth + sigma_0 * cos, growth + sigma_0
    near = dx < x0
    if near.any():
        ramp = dx / x0
        start = (1 - ramp) * 0.501 * D * np.sqrt(C_T / 2)
        sigma_y = np.where(near, start + ramp * sigma_0 * cos, sigma_y)
        sigma_z = np.where(near, start + ramp * sigma_0, sigma_z)
    blocked = C_T * cos * D**2 / (8 * sigma_y * sigma_z)
    C = 1 - np.sqrt(np.clip(1 - blocked, 0.0, 1.0))
    C *= dx > CLOSE
    lateral = C * np.exp(-0.5 * ((dy - deflection(rotor, dx)) / sigma_y) ** 2)
    vertical = np.exp(-0.5 * (dz / sigma_z[..., None]) ** 2)
    loss: Floats = lateral[..., None] * vertical
    return loss


def added_turbulence(rotor: Rotor, ambient: float, dx: Floats) -> Floats:
    """Return the turbulence intensity that a rotor adds where it is wholly in the wake [-].

    Shape ``(B, S, m, 1)``; ``dx`` [m] has the shape ``(S, m, 1)``.
    """
    cos = rotor.cos
    a = 0.5 / cos * (1 - np.sqrt(1 - rotor.C_T * cos))
    distance = np.maximum(dx, CLOSE) / rotor.D
    added: Floats = 0.5 * a**0.8 * ambient**0.1 * distance**-0.32
    return added
