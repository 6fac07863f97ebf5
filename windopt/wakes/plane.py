"""The wind over a farm at any places: what a picture of wakes shows."""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.yaw_problem import YawProblem
from windopt.wakes.farm import flow
from windopt.wakes.gaussian import Rotor, deficit

Floats = NDArray[np.float64]


def wind_speeds(problem: YawProblem, yaw: Floats, places: Floats, *, wind: int = 0) -> Floats:
    """Return the wind speed [m/s] at the reference height.

    Parameters
    ----------
    problem
        The farm and its winds.
    yaw
        Misalignments [rad], shape ``(n,)``.
    places
        Easting and northing [m], shape ``(k, 2)``.
    wind
        Which of the problem's winds blows.

    Returns
    -------
    Shape ``(k,)``. Rotors feel turbulence that differs from side to side; here each wake grows by
    the mean of its rotor's.
    """
    found = flow(problem, yaw)
    theta = problem.wind_directions[wind] - 1.5 * np.pi
    east = np.array([np.cos(theta), -np.sin(theta)])
    north = np.array([np.sin(theta), np.cos(theta)])
    slowed = np.zeros(len(places))
    for i, turbine in enumerate(problem.turbines):
        x, y = (places - turbine) @ east, (places - turbine) @ north
        behind = x > 0
        rotor = Rotor(
            problem.rotor_diameters[i].reshape(1, 1, 1),
            np.reshape(yaw[i], (1, 1, 1, 1)),
            found.thrust[wind, i].reshape(1, 1, 1, 1),
            found.turbulence[wind, i].reshape(1, 1, 1, 1),
        )
        dx, dy = x[behind][None, :, None], y[behind][None, :, None]
        dz = np.full(dx.shape, problem.reference_height - problem.hub_heights[i])[..., None]
        slowed[behind] += deficit(rotor, dx, dy, dz)[0, 0, :, 0, 0] ** 2
    speeds: Floats = problem.wind_speeds[wind] * (1 - np.sqrt(slowed))
    return speeds
