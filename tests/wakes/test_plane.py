"""The wind between turbines: free upstream, slow behind rotors, and as the rotors feel it."""

import numpy as np
import pytest

from windopt.domain.power_curve import PowerCurve
from windopt.domain.yaw_problem import YawProblem
from windopt.wakes.farm import flow
from windopt.wakes.plane import wind_speeds

D = 120.0
CURVE = PowerCurve.stand_in(0.45, np.pi * D**2 / 4, 5e6, 3.0, 25.0)
PROBLEM = YawProblem(
    np.array([[0.0, 0.0], [7 * D, 0.0]]),
    (CURVE,),
    np.zeros(2, dtype=int),
    np.full(2, D),
    np.full(2, 90.0),
    np.array([8.0, 8.0]),
    np.radians([270.0, 90.0]),
    np.full(2, 0.5),
    0.06,
    np.full(2, -0.5),
    np.full(2, 0.5),
)


def test_upstream_and_aside_the_wind_is_free():
    places = np.array([[-D, 0.0], [3 * D, 5 * D]])
    assert wind_speeds(PROBLEM, np.zeros(2), places) == pytest.approx(8.0, abs=1e-3)


def test_it_is_slowest_behind_a_rotor_and_recovers():
    near, far = wind_speeds(PROBLEM, np.zeros(2), np.array([[3 * D, 0.0], [6.9 * D, 0.0]]))
    assert near < far < 8.0


def test_a_turned_rotor_leads_its_wake_aside():
    across = np.c_[np.full(81, 6 * D), np.linspace(-2 * D, 2 * D, 81)]
    left, right = (
        across[wind_speeds(PROBLEM, np.array([gamma, 0.0]), across).argmin(), 1]
        for gamma in (-0.4, 0.4)
    )
    assert left == pytest.approx(-right)
    assert left > 0.2 * D


def test_a_rotor_feels_what_blows_over_it():
    felt = flow(PROBLEM, np.array([0.3, 0.0])).speeds[0, 1]
    there = wind_speeds(PROBLEM, np.array([0.3, 0.0]), PROBLEM.turbines[1:])[0]
    assert felt == pytest.approx(there, rel=0.1)


def test_another_wind_blows_from_elsewhere():
    behind = np.array([[-2 * D, 0.0]])
    assert wind_speeds(PROBLEM, np.zeros(2), behind, wind=1) < 6.0
