"""Wake steering: known optima, never worse than its rival, and honest about its bound."""

import numpy as np
import pytest

from windopt.domain.yaw_problem import YawProblem
from windopt.heuristics.serial_refine import serial_refine
from windopt.result import Result, Status
from windopt.solving import farm_yaw
from windopt.solving.farm_yaw import steer
from windopt.wakes.farm import farm_power, turbine_powers


def gain(problem, result):
    return result.objective / farm_power(problem, np.zeros(len(problem))) - 1


def test_a_row_of_three_is_steered_as_far_as_no_small_turn_gains(steered, row):
    problem = steered(row(3), direction=272.0)
    result = steer(problem)
    turned = result.found() + np.radians(0.5) * np.vstack([np.eye(3), -np.eye(3)])
    turned = np.clip(turned, problem.lower, problem.upper)
    assert result.status is Status.LOCALLY_OPTIMAL
    assert result.found()[2] == pytest.approx(0.0, abs=1e-3)
    assert farm_power(problem, turned).max() <= result.objective * (1 + 1e-5)


def test_it_is_the_best_of_a_grid_of_two_turbines(steered, row):
    problem = steered(row(2), direction=271.0)
    a = np.radians(np.arange(-25, 25.1, 0.25))
    best = farm_power(problem, np.c_[a, np.zeros(len(a))]).max()
    assert steer(problem).objective >= best * (1 - 1e-6)


@pytest.mark.parametrize("unlike", [False, True])
@pytest.mark.parametrize("direction", [180.0, 222.0, [268.0, 270.0, 272.0]])
def test_it_never_delivers_less_than_serial_refine(steered, scattered, direction, unlike):
    problem = steered(scattered(12, seed=1), direction=direction, unlike=unlike)
    result = steer(problem)
    assert result.objective >= serial_refine(problem).objective
    assert result.objective == pytest.approx(float(farm_power(problem, result.found())))
    assert result.objective <= result.bound
    assert (problem.lower <= result.found()).all()
    assert (result.found() <= problem.upper).all()


def test_a_wind_that_brings_all_to_rated_power_is_proved_optimal(steered, row):
    result = steer(steered(row(3, 9.0), speed=18.0))
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(3 * 5e6)


def test_no_turbine_exceeds_its_rated_power(steered, scattered):
    problem = steered(scattered(8), speed=11.5)
    assert turbine_powers(problem, steer(problem).found()).max() <= 5e6


def test_a_farm_at_its_cap_is_proved_optimal(steered, row):
    result = steer(steered(row(3), farm_cap=2e6))
    assert (result.status, result.objective) == (Status.OPTIMAL, 2e6)


@pytest.mark.parametrize("speed", [0.0, 2.0])
def test_no_power_is_no_reason_to_turn(steered, row, speed):
    result = steer(steered(row(3), speed=speed))
    assert (result.objective, result.status) == (0.0, Status.OPTIMAL)
    assert (result.found() == 0).all()


def test_no_time_leaves_the_rotors_facing_the_wind(steered, row):
    result = steer(steered(row(3)), time_limit=0.0)
    assert result.status is Status.FEASIBLE
    assert "The time limit was reached." in result.reason
    assert (result.found() == 0).all()


def test_ctrl_c_while_the_wakes_compile_leaves_the_rotors_facing_the_wind(
    steered, row, monkeypatch
):
    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(farm_yaw, "Sweep", stopped)
    problem = steered(row(3), direction=272.0)
    result = steer(problem)
    assert result.status is Status.INTERRUPTED
    assert (result.found() == 0).all()
    assert result.objective == pytest.approx(float(farm_power(problem, np.zeros(3))))


def test_an_ipopt_that_does_not_converge_is_said(steered, row, monkeypatch):
    monkeypatch.setattr(farm_yaw, "FROM_NEARBY", {"max_iter": 0})
    monkeypatch.setattr(farm_yaw, "FROM_AFAR", {"max_iter": 0})
    problem = steered(row(3), direction=272.0)
    result = steer(problem)
    assert result.status is Status.FEASIBLE
    assert result.reason.startswith("Ipopt did not converge: The limit of iterations was reached.")
    assert result.objective >= serial_refine(problem).objective


def test_only_what_lies_near_a_converged_point_is_called_locally_optimal():
    end = Result(Status.LOCALLY_OPTIMAL, np.full(3, 0.3), 0.0, 0.0, 0.0)
    assert farm_yaw.verdict(np.full(3, 0.25), [end]) == (Status.LOCALLY_OPTIMAL, farm_yaw.NEARBY)
    assert farm_yaw.verdict(np.zeros(3), [end]) == (Status.FEASIBLE, farm_yaw.FAR)


def test_a_proof_needs_no_reason(steered, row):
    assert steer(steered(row(3), farm_cap=2e6)).reason == ""


def test_a_warm_start_is_never_lost(steered, scattered):
    problem = steered(scattered(10), direction=222.0)
    known = serial_refine(problem).found()
    assert steer(problem, start=known).objective >= farm_power(problem, known)


def test_one_sided_bounds_are_kept(steered, row):
    p = steered(row(3), direction=269.0)
    problem: YawProblem = p.between(np.full(3, 0.0), np.full(3, 0.2))
    yaw = steer(problem).found()
    assert ((yaw >= 0) & (yaw <= 0.2)).all()


def test_more_room_to_turn_never_delivers_less(steered, row):
    p = steered(row(4), direction=272.0)
    powers = [steer(p.between(*np.radians([[-b] * 4, [b] * 4]))).objective for b in (5, 15, 25)]
    assert (np.diff(powers) >= -1e-6 * powers[0]).all()
