"""The rows of :mod:`formulations.farm_yaw`, each written for one turbine or one pair of turbines.

A row is a function of SX, from the variables and the parameters of a member to its terms; equation
numbers are those of the program.
"""

from functools import cache, lru_cache

import casadi as ca

from formulations.power_curve import CORNER, Curve, linear_pieces
from formulations.wake import raised_turbulence, squared_deficits

EPSILON = 5e-5
"""Deficits are smooth within this of zero."""


@lru_cache(maxsize=64)
def power(curve: Curve, air_density: float, scale: float) -> ca.Function:
    """Return a turbine's row of (2), as a fraction of ``scale``."""
    v, u = ca.SX.sym("v", 4), ca.SX.sym("u")
    e, gamma, U, r = ca.vertsplit(v)
    density = (air_density / curve.air_density) ** (1 / 3)
    effective = density * u * U * ca.cos(gamma) ** (curve.yaw_exponent / 3)
    P = linear_pieces(effective, curve.speeds, [each / scale for each in curve.powers], CORNER)
    return ca.Function("power", [v, u], [e - r * P])


@cache
def mean(P: int) -> ca.Function:
    """Return row (3) of a rotor with P points."""
    v, c = ca.SX.sym("v", 1 + P), ca.SX.sym("c", P)
    U, W = v[0], v[1:]
    return ca.Function("mean", [v, c], [U - ca.dot(c, (1 - W) ** 3) ** (1 / 3)])


@cache
def superposed(P: int) -> ca.Function:
    """Return the left-hand sides of (4) of a rotor with P points."""
    W = ca.SX.sym("W", P)
    return ca.Function("superposed", [W, ca.SX.sym("p", 0)], [W**2 + 2 * EPSILON * W])


@cache
def squares(rows: int) -> ca.Function:
    """Return the squared deficits that a source (yaw, C_T, I) makes at the points of a rotor.

    Its parameters are how far downstream and to the left it stands, how far aside its outer
    columns of points are, and how high its rows, all in diameters of the source.
    """
    v, p = ca.SX.sym("v", 3), ca.SX.sym("p", 3 + rows)
    dx, dy, side, *dz = ca.vertsplit(p)
    d2 = squared_deficits(dx, [dy, dy - side, dy + side], dz, *ca.vertsplit(v))
    return ca.Function("squares", [v, p], [d2])


@cache
def taken(rows: int) -> ca.Function:
    """Return one source's part in the right-hand sides of (4)."""
    v, p = squares(rows).sx_in()
    return ca.Function("taken", [v, p], [-squares(rows)(v, p)])


@lru_cache(maxsize=64)
def thrust(curve: Curve) -> ca.Function:
    """Return row (5)."""
    v, u = ca.SX.sym("v", 4), ca.SX.sym("u")
    gamma, U, r, C = ca.vertsplit(v)
    C_T = linear_pieces(u * U, curve.speeds, curve.thrusts, CORNER)
    return ca.Function("thrust", [v, u], [C - r * C_T * ca.cos(gamma)])


@cache
def turbulence() -> ca.Function:
    """Return row (6)."""
    v, p = ca.SX.sym("v", 3), ca.SX.sym("p", 2)
    I, gamma, C = ca.vertsplit(v)  # noqa: E741
    kappa, ambient = ca.vertsplit(p)
    return ca.Function("turbulence", [v, p], [I - raised_turbulence(ambient, kappa, gamma, C)])


@cache
def turned() -> ca.Function:
    """Return row (8)."""
    v, shift = ca.SX.sym("v", 2), ca.SX.sym("shift")
    return ca.Function("turned", [v, shift], [shift - v[0] + v[1]])


@cache
def itself() -> ca.Function:
    """Return a variable times its weight."""
    v, weight = ca.SX.sym("v"), ca.SX.sym("weight")
    return ca.Function("itself", [v, weight], [weight * v])
