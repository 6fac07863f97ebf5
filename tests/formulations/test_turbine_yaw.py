"""The yaw program against its closed form, from any start, and its own first-order conditions."""

from math import acos, pi

import casadi as ca
import numpy as np
import pytest

from formulations.rotor import MODELS, PITCH, TIP_SPEED_RATIO, power
from formulations.turbine_yaw import EPSILON, turbine_yaw
from windopt.solving.nonlinear import solve

RHO, A, P_RATED = 1.065, 21_900.0, 8e6
PROGRAMS = {
    name: turbine_yaw(model, rho=RHO, A=A, p_rated=P_RATED) for name, model in MODELS.items()
}
SPEEDS = (4.0, 8.0, 11.6, 14.0, 24.0)  # m/s; 11.6 is close to the rated wind of each model
BIAS = 2 * EPSILON * pi  # rad; what the wish for little travel may cost below rated power


def rated_wind(name):
    return (P_RATED / power(RHO, A, 1.0, 1.0, MODELS[name].best().C_p)) ** (1 / 3)


def most(name, w):
    return min(P_RATED, power(RHO, A, w, 1.0, MODELS[name].best().C_p))


def nearest_optimal_yaw(name, w, gamma_0):
    """Stay, or turn until cos(gamma) = 1 / v: the closed form."""
    reach = acos(min(1.0, rated_wind(name) / w))
    return float(np.clip(gamma_0, -reach, reach))


def optimum(name, w, gamma_0=0.0, start=None):
    program = PROGRAMS[name]
    program.opti.set_value(program.w, w)
    program.opti.set_value(program.gamma_0, gamma_0)
    return solve(program, starts=[program.start if start is None else start]).found()


def delivered(name, w, x):
    """Power by the paper's eq. 1 of the yaw, tip-speed ratio and pitch decided [W]."""
    gamma, lam, beta, *_ = x
    return power(RHO, A, w, np.cos(gamma), MODELS[name](lam, beta))


def random_start(rng):
    low, high = np.array([(-pi / 2, pi / 2), TIP_SPEED_RATIO, PITCH, (0, 1), (0, 1)]).T
    return rng.uniform(low, high)


@pytest.mark.parametrize("n", [8, pytest.param(80, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", MODELS)
def test_any_start_reaches_the_certified_power_by_the_shortest_turn(name, n):
    rng = np.random.default_rng(0)
    for w in SPEEDS:
        for gamma_0 in rng.uniform(-pi, pi, n):
            x = optimum(name, w, gamma_0, random_start(rng))
            assert delivered(name, w, x) == pytest.approx(most(name, w), rel=1e-7)
            wanted = nearest_optimal_yaw(name, w, gamma_0)
            assert x[0] == pytest.approx(wanted, abs=1e-3 if w > rated_wind(name) else BIAS)


@pytest.mark.parametrize("gamma_0", [0.0, 0.5, pi / 2, -pi, pi])
def test_a_lone_turbine_faces_a_wind_below_rated(gamma_0):
    gamma, lam, beta, _, _ = optimum("slootweg", 8.0, gamma_0)
    best = MODELS["slootweg"].best()
    assert gamma == pytest.approx(0.0, abs=1.01 * BIAS)
    assert (lam, beta) == pytest.approx((best.lam, best.beta), abs=1e-4)


def test_a_turbine_above_rated_stays_where_it_is_good_enough():
    assert optimum("slootweg", 14.0, 0.3)[0] == pytest.approx(0.3, abs=1e-5)


@pytest.mark.parametrize("w", SPEEDS)
def test_mirrored_nacelles_get_mirrored_yaws(w):
    right, left = optimum("slootweg", w, 0.8)[0], optimum("slootweg", w, -0.8)[0]
    assert right == pytest.approx(-left, abs=1e-5)


@pytest.mark.parametrize("name", MODELS)
def test_the_rated_power_is_never_exceeded(name):
    program = PROGRAMS[name]
    for w in np.linspace(11.3, 25, 30):
        x = optimum(name, w, 0.2)
        assert x[3] <= 1.0
        assert ca.Function("p", [program.x], [program.power])(x) <= P_RATED


def test_more_wind_never_delivers_less():
    powers = [delivered("slootweg", w, optimum("slootweg", w)) for w in np.linspace(3, 25, 45)]
    assert (np.diff(powers) >= -1e-7 * P_RATED).all()


def test_the_power_decided_is_that_of_the_papers_first_equation():
    for w in SPEEDS:
        x = optimum("heier", w, 1.0)
        assert P_RATED * x[3] ** 3 == pytest.approx(delivered("heier", w, x), rel=1e-8)


@pytest.mark.parametrize("w", [8.0, 14.0])
def test_first_order_conditions_hold_at_the_optimum(w):
    program = PROGRAMS["slootweg"]
    x = optimum("slootweg", w, 1.0)
    opti = program.opti
    stationarity = ca.gradient(opti.f + ca.dot(opti.lam_g, opti.g), opti.x)
    residual = np.abs(opti.debug.value(stationarity)).max()
    assert residual < 1e-6
    assert opti.debug.value(opti.x) == pytest.approx(x)


def test_gradients_are_those_of_finite_differences():
    program = PROGRAMS["mathworks"]
    opti = program.opti
    opti.set_value(program.w, 13.0)
    opti.set_value(program.gamma_0, 0.4)
    values = ca.vertcat(opti.f, opti.g)
    rows = ca.Function("rows", [opti.x, opti.p], [values])
    slopes = ca.Function("slopes", [opti.x, opti.p], [ca.jacobian(values, opti.x)])
    x, p, h = np.array([0.3, 6.0, 4.0, 0.8, 0.7]), opti.debug.value(opti.p), 1e-6
    differences = [np.array(rows(x + d, p) - rows(x - d, p)) / (2 * h) for d in h * np.eye(5)]
    assert np.array(slopes(x, p)) == pytest.approx(np.hstack(differences), abs=1e-7)
