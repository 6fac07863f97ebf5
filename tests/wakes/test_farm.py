"""The wind and power under wakes: known limits and symmetries."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from windopt.domain.power_curve import PowerCurve
from windopt.domain.yaw_problem import YawProblem
from windopt.errors import InvalidInput
from windopt.wakes.farm import farm_power, flow, turbine_powers

D = 120.0

CURVE = PowerCurve.stand_in(0.45, np.pi * D**2 / 4, 5e6, 3.0, 25.0)
"""Of a turbine of 5 MW."""


def problem(xy, *, speed=8.0, direction=270.0, turbulence=0.06, **options):
    """Return turbines of 5 MW at ``xy`` [m] in one wind, with bounds of 30 deg."""
    xy = np.array(xy, dtype=float)
    n = len(xy)
    speeds, directions = np.atleast_1d(np.array(speed, float)), np.atleast_1d(direction)
    S = max(len(speeds), len(directions))
    options.setdefault("weights", np.full(S, 1 / S))
    return YawProblem(
        xy,
        (CURVE,),
        np.zeros(n, dtype=int),
        np.full(n, D),
        np.full(n, 90.0),
        np.broadcast_to(speeds, S),
        np.broadcast_to(np.radians(directions), S),
        turbulence=turbulence,
        lower=np.full(n, -np.pi / 6),
        upper=np.full(n, np.pi / 6),
        **options,
    )


def row(n, spacing=5.0):
    """Return ``n`` turbines from west to east, ``spacing`` diameters apart [m]."""
    return np.c_[spacing * D * np.arange(n), np.zeros(n)]


def random(seed, n=6, **options):
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, 15 * D, (n, 2))
    options = {"direction": rng.uniform(0, 360), "speed": rng.uniform(5, 14)} | options
    return problem(xy, **options), rng.uniform(-0.5, 0.5, n)


def test_a_lone_turbine_follows_the_cosine_law():
    one = problem([[0.0, 0.0]], shear=0.0)
    gamma = np.linspace(-0.5, 0.5, 11)[:, None]
    expected = CURVE.power(8.0 * np.cos(gamma[:, 0]))
    assert turbine_powers(one, gamma)[:, 0, 0] == pytest.approx(expected, rel=1e-12)


def test_turbines_far_apart_do_not_feel_each_other():
    abreast = problem(row(3, spacing=100.0), direction=0.0)
    alone = problem([[0.0, 0.0]], direction=0.0)
    assert turbine_powers(abreast, np.zeros(3)) == pytest.approx(
        np.full((1, 3), turbine_powers(alone, np.zeros(1))[0, 0])
    )


def test_the_second_turbine_of_a_row_suffers_most_and_turning_the_first_helps_it():
    three = problem(row(3))
    faced = turbine_powers(three, np.zeros(3))[0]
    assert faced[1] < 0.6 * faced[0]
    turned = turbine_powers(three, np.radians([25.0, 0.0, 0.0]))[0]
    assert turned[0] < faced[0]
    assert turned[1] > 1.2 * faced[1]


def test_a_positive_misalignment_moves_the_wake_to_the_right():
    west = problem([[0.0, 0.0], [7 * D, -0.5 * D], [7 * D, 0.5 * D]])
    right, left = turbine_powers(west, np.radians([25.0, 0.0, 0.0]))[0, 1:]
    assert right < left


def test_wakes_mix_sooner_in_rougher_air():
    smooth, rough = (problem(row(2), turbulence=t) for t in (0.05, 0.15))
    assert farm_power(rough, np.zeros(2)) > farm_power(smooth, np.zeros(2))


@pytest.mark.parametrize("seed", range(5))
def test_a_mirrored_farm_mirrors_the_misalignments(seed):
    farm, gamma = random(seed)
    mirrored = replace(
        farm, turbines=farm.turbines * [-1, 1], wind_directions=-farm.wind_directions
    )
    assert turbine_powers(mirrored, -gamma) == pytest.approx(turbine_powers(farm, gamma), rel=1e-9)


@given(seed=st.integers(0, 1000), angle=st.floats(0, 2 * np.pi), shift=st.floats(-1e6, 1e6))
@settings(max_examples=15, deadline=None)
def test_farm_and_wind_may_turn_and_move_together(seed, angle, shift):
    farm, gamma = random(seed, n=4)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = replace(
        farm,
        turbines=farm.turbines @ turn.T + shift,
        wind_directions=farm.wind_directions - angle,
    )
    assert farm_power(turned, gamma) == pytest.approx(farm_power(farm, gamma), rel=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_the_order_of_turbines_does_not_matter(seed):
    farm, gamma = random(seed)
    order = np.random.default_rng(seed).permutation(len(farm))
    relabelled = replace(farm, turbines=farm.turbines[order])
    expected = turbine_powers(farm, gamma)[:, order]
    assert turbine_powers(relabelled, gamma[order]) == pytest.approx(expected, rel=1e-12)


def test_several_winds_and_misalignments_at_once_are_those_one_by_one():
    farm, _ = random(0, direction=[262.0, 270.0, 281.0], speed=9.0)
    gamma = np.random.default_rng(1).uniform(-0.5, 0.5, (2, 3, 6))
    powers = turbine_powers(farm, gamma)
    assert powers.shape == (2, 3, 3, 6)
    for s, direction in enumerate(farm.wind_directions):
        single = replace(
            farm,
            wind_speeds=farm.wind_speeds[:1],
            wind_directions=np.array([direction]),
            weights=np.ones(1),
        )
        assert turbine_powers(single, gamma[1, 2])[0] == pytest.approx(powers[1, 2, s], rel=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_no_turbine_exceeds_what_it_delivers_unwaked(seed):
    farm, gamma = random(seed, speed=[8.0, 13.0, 26.0], direction=40.0)
    powers = turbine_powers(farm, gamma)
    assert (powers <= farm.unwaked * (1 + 1e-12)).all()
    assert (powers <= 5e6).all()
    assert farm_power(farm, gamma) <= farm.bound


def test_the_farms_cap_is_kept():
    farm = problem(row(4), speed=[8.0, 14.0], farm_cap=6e6)
    free = turbine_powers(farm, np.zeros(4)).sum(axis=1)
    assert free[0] < 6e6 < free[1]
    assert farm_power(farm, np.zeros(4)) == pytest.approx((free[0] + 6e6) / 2)


def test_a_direction_without_wakes_needs_no_pairs():
    assert flow(problem([[0.0, 0.0]]), np.zeros((0, 1))).powers.shape == (0, 1, 1)


def test_misalignments_of_another_farm_are_refused():
    with pytest.raises(InvalidInput, match=r"yaw of shape \(\.\.\., 3\)"):
        turbine_powers(problem(row(3)), np.zeros(2))
