"""The compiled wakes against those that judge every set-point."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.solving.rotor_by_rotor import refine
from windopt.solving.wake_sweep import Sweep
from windopt.wakes.farm import farm_power


@pytest.mark.parametrize("unlike", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_trials_and_turns_have_the_exact_power(steered, scattered, seed, unlike):
    rng = np.random.default_rng(seed)
    directions, n = rng.uniform(0, 360, 2), 15
    problem = steered(scattered(n, seed), speed=9.0, direction=directions, unlike=unlike)
    yaw = rng.uniform(-0.4, 0.4, n)
    sweep = Sweep(problem, yaw)
    assert sweep.power == pytest.approx(farm_power(problem, yaw), rel=1e-12)
    for i in rng.permutation(n):
        yaws = rng.uniform(-0.4, 0.4, 3)
        turned = np.repeat(yaw[None], 3, axis=0)
        turned[:, i] = yaws
        assert sweep.tried(i, yaws) == pytest.approx(farm_power(problem, turned), rel=1e-9)
        sweep.turn(i, yaws[0])
        yaw = turned[0]
    assert sweep.power == pytest.approx(farm_power(problem, yaw), rel=1e-9)


def test_wide_wakes_in_rough_air_are_not_cut_off(steered, scattered):
    problem = replace(steered(scattered(20), direction=[10.0, 100.0]), turbulence=0.25)
    yaw = np.linspace(-0.4, 0.4, 20)
    assert Sweep(problem, yaw).power == pytest.approx(farm_power(problem, yaw), rel=1e-9)


def test_a_capped_farm_counts_what_the_grid_takes(steered, row):
    sweep = Sweep(steered(row(3), farm_cap=1e6), np.zeros(3))
    assert sweep.power == 1e6
    assert sweep.tried(0, np.array([0.1])) == pytest.approx(1e6)


def test_refining_never_loses(steered, scattered):
    problem = steered(scattered(10), direction=[200.0, 205.0])
    yaw = np.random.default_rng(0).uniform(-0.3, 0.3, 10)
    assert farm_power(problem, refine(Sweep(problem, yaw))) >= farm_power(problem, yaw)


def test_refining_stays_near_where_it_is_asked_to(steered, row):
    yaw = refine(Sweep(steered(row(4)), np.zeros(4)), around=0.05, passes=(4,))
    assert np.abs(yaw).max() <= 0.05 + 1e-12


def test_a_deadline_that_has_passed_turns_no_rotor(steered, row):
    assert (refine(Sweep(steered(row(4)), np.zeros(4)), deadline=0.0) == 0).all()
