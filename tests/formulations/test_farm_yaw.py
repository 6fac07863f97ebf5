"""The lifted program against the exact wakes, its own derivatives and its symmetries."""

import casadi as ca
import numpy as np
import pytest

from formulations.farm_wakes import wakes
from formulations.farm_yaw import Turns, farm_yaw
from formulations.power_curve import Curve
from windopt.solving.farm_yaw import FROM_AFAR, in_wind
from windopt.solving.separable import prepared, search
from windopt.wakes.farm import farm_power, flow

SMOOTH = 3e-4
"""By how much the smooth model may differ from the exact one, of the power."""


def built(problem, yaw, **options):
    farm, bounds = in_wind([problem]), (problem.lower, problem.upper)
    return farm_yaw(farm, wakes(farm, np.atleast_2d(yaw), bounds), bounds=bounds, **options)


def optimum(problem, yaw, **options):
    """Return the misalignments and the power of the smooth model where Ipopt ends."""
    lift = built(problem, np.full(len(problem), yaw), **options)
    found = search(prepared(lift.program, options=FROM_AFAR), lift.start)
    return found.found()[lift.gamma[0]], -found.objective * lift.scale


@pytest.mark.parametrize("unlike", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_the_smooth_wakes_are_the_exact_ones(steered, scattered, seed, unlike):
    rng = np.random.default_rng(seed)
    problem = steered(scattered(12, seed), direction=rng.uniform(0, 360, 3), unlike=unlike)
    yaw = rng.uniform(-0.4, 0.4, 12)
    found, exact = wakes(in_wind([problem]), yaw[None], (-yaw, yaw)), flow(problem, yaw)
    total = problem.weights @ found.powers.sum(axis=1)
    assert total == pytest.approx(farm_power(problem, yaw), rel=SMOOTH)
    assert pytest.approx(exact.turbulence, abs=5e-3) == found.I  # counted in ninths
    assert pytest.approx(exact.thrust, abs=2e-3) == found.C_T


@pytest.mark.parametrize("unlike", [False, True])
def test_the_rows_nearly_hold_at_the_start(steered, scattered, unlike):
    problem = steered(scattered(8), direction=[250, 255], unlike=unlike)
    program = (lift := built(problem, np.linspace(-0.2, 0.3, 8))).program
    g = np.array(ca.Function("g", [program.x], [program.g])(lift.start)).ravel()
    assert (np.maximum(program.lower_g - g, g - program.upper_g) < SMOOTH).all()


def test_derivatives_are_those_of_finite_differences(steered, scattered):
    program = (lift := built(steered(scattered(5)), np.linspace(-0.2, 0.3, 5))).program
    rows = ca.Function("rows", [program.x], [ca.vertcat(program.f, program.g)])
    slopes = ca.Function("slopes", [program.x], [ca.vertcat(program.gradient.T, program.jacobian)])
    h, x = 1e-6, lift.start
    sides = [np.array(rows(x + d)) - np.array(rows(x - d)) for d in h * np.eye(len(x))]
    assert np.array(slopes(x)) == pytest.approx(np.hstack(sides) / (2 * h), abs=1e-6)


def test_first_order_conditions_hold_at_the_optimum(steered, row):
    lift = built(steered(row(4), direction=273.0), np.full(4, 0.1))
    program, solver = lift.program, prepared(lift.program, options=FROM_AFAR).solver
    bounds = {"lbx": program.lower_x, "ubx": program.upper_x}
    found = solver(x0=lift.start, lbg=program.lower_g, ubg=program.upper_g, **bounds)
    slopes = ca.Function("slopes", [program.x], [program.gradient, program.jacobian])
    gradient, jacobian = (np.array(a) for a in slopes(found["x"]))
    multipliers = jacobian.T @ np.array(found["lam_g"]) + np.array(found["lam_x"])
    assert gradient + multipliers == pytest.approx(np.zeros_like(gradient), abs=1e-5)


def test_a_mirrored_farm_mirrors_the_yaws(steered, scattered):
    xy = np.array(scattered(6, seed=3))
    yaw, power = optimum(steered(xy), 0.1)
    mirrored, same = optimum(steered(xy * [1, -1]), -0.1)
    assert mirrored == pytest.approx(-yaw, abs=1e-3)
    assert same == pytest.approx(power, rel=1e-6)


def test_without_wakes_every_rotor_faces_the_wind(steered):
    yaw, power = optimum(problem := steered([(0, 0), (0, 8), (1, 16)]), 0.2)
    assert yaw == pytest.approx(np.zeros(3), abs=1e-3)
    assert power == pytest.approx(farm_power(problem, np.zeros(3)), rel=SMOOTH)


def test_zero_yaw_in_a_row_is_stationary_and_not_the_best(steered, row):
    _, faced = optimum(steered(row(3)), 0.0)
    _, turned = optimum(steered(row(3)), 0.1)
    assert turned > 1.05 * faced


def test_the_rated_power_and_the_cap_are_kept(steered, row):
    problem = steered(row(4), speed=11.0, direction=271.0)
    _, free = optimum(problem, 0.1)
    _, capped = optimum(problem, 0.1, cap=0.8 * free)
    assert free <= 4 * 5e6 * (1 + 1e-9)
    assert capped == pytest.approx(0.8 * free, rel=1e-6)


def test_a_curve_goes_on_rising_only_where_its_power_stays_at_rated():
    kept = Curve((3.0, 5.0, 7.0, 9.0), (0.0, 1.0, 3.0, 3.0), (0.8,) * 4, 3.0, 1.225)
    assert kept.rising().powers == (0.0, 1.0, 3.0)
    falling = kept._replace(powers=(0.0, 1.0, 3.0, 2.0))
    assert falling.rising() == falling


def test_derated_turbines_add_up_to_the_cap(steered, row):
    problem = steered(row(3), speed=10.0, direction=275.0)
    _, free = optimum(problem, 0.1)
    lift = built(problem, np.full(3, 0.1), cap=0.7 * free, least=0.2)
    found = search(prepared(lift.program, options=FROM_AFAR), lift.start)
    r = found.found()[lift.r]
    assert -found.objective * lift.scale == pytest.approx(0.7 * free, rel=1e-6)
    assert (r >= 0.2 - 1e-9).all()
    assert r.min() < 0.95


def test_room_to_derate_never_delivers_less(steered, row):
    problem = steered(row(4), direction=270.0)
    powers = [optimum(problem, 0.1, least=least)[1] for least in (1.0, 0.8)]
    assert powers[1] >= powers[0] * (1 - 1e-5)


def test_steps_turn_only_as_far_as_allowed(steered, row):
    problems = [steered(row(3), direction=direction) for direction in (268.0, 270.0, 275.0)]
    farm, bounds = in_wind(problems), (problems[0].lower, problems[0].upper)
    start = np.outer([0.05, 0.05, 0.1], np.ones(3))
    turns = Turns(np.radians(2.0), np.radians([2.0, 5.0]))
    lift = farm_yaw(farm, wakes(farm, start, bounds), bounds=bounds, turns=turns)
    yaw = search(prepared(lift.program, options=FROM_AFAR), lift.start).found()[lift.gamma]
    turned = turns.shifts[:, None] - np.diff(yaw, axis=0)
    assert np.abs(turned).max() <= turns.most + 1e-6
