"""Column generation against all subsets of turbines, and against itself in other clothes."""

import signal
import subprocess
import sys
from dataclasses import replace
from threading import Timer
from time import perf_counter

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation


def duration_is_kept(instance, routes):
    for route in routes:
        assert instance.duration(route) <= instance.t_max[route.station] * (1 + 1e-9)
        assert instance.allowed[route.station, list(route.turbines)].all()
    visited = sorted(i for route in routes for i in route.turbines)
    assert visited == list(range(len(instance.turbines)))


@pytest.mark.parametrize("seed", range(100))
def test_optimum_equals_enumeration(small, seed):
    instance = small.random_instance(seed)
    best = small.optimum(instance)
    result = column_generation(instance)
    if np.isinf(best):
        assert result.status is Status.INFEASIBLE
        return
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(best, rel=1e-9)
    assert result.bound == pytest.approx(best, rel=1e-8)
    assert instance.total(result.solution) == pytest.approx(best, rel=1e-9)
    duration_is_kept(instance, result.solution)


@pytest.mark.slow
@pytest.mark.parametrize("block", range(2))
def test_optimum_equals_enumeration_on_many_more(small, block):
    for seed in range(1000 * (block + 1), 1000 * (block + 2)):
        instance = small.random_instance(seed)
        best = small.optimum(instance)
        result = column_generation(instance)
        status = Status.OPTIMAL if np.isfinite(best) else Status.INFEASIBLE
        assert result.status is status, seed
        assert result.objective == pytest.approx(best, rel=1e-9), seed


@pytest.mark.parametrize("seed", range(300, 340))
def test_branching_finds_the_same_optimum(small, monkeypatch, seed):
    monkeypatch.setattr("windopt.solving.exact.staged_mip.SIZES", (1,))
    monkeypatch.setattr("windopt.solving.exact.tightening.ROUNDS", 1)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is (Status.OPTIMAL if result.solution else Status.INFEASIBLE)


def grid(side, t_max, spacing=700.0, wind=8.0):
    """Return a square farm with one station in its middle."""
    x, y = np.meshgrid(spacing * np.arange(side), spacing * np.arange(side))
    turbines = np.c_[x.ravel(), y.ravel()] + 20.0 * np.random.default_rng(0).random((side**2, 2))
    stations = turbines.mean(axis=0, keepdims=True)
    nodes = np.vstack([stations, turbines])
    leg = nodes[None] - nodes[:, None]
    length = np.hypot(leg[..., 0], leg[..., 1])
    along = wind * leg[..., 0] / np.where(length > 0, length, 1.0)
    speed = along + np.sqrt(256.0 - wind**2 + along**2)
    t = np.where(length > 0, length / np.minimum(speed, 16.0), 0.0)[None]
    allowed = np.ones((1, side**2), bool)
    return RoutingInstance(t, np.array([t_max]), stations, turbines, np.array([wind, 0.0]), allowed)


def test_plan_and_bound_only_improve():
    seen = []
    result = column_generation(grid(6, 900.0), progress=lambda *pair: seen.append(pair))
    objectives, bounds = zip(*seen, strict=True)
    assert list(objectives) == sorted(objectives, reverse=True)
    assert all(bound <= objective + 1e-6 for objective, bound in seen)
    assert max(bounds) == pytest.approx(result.bound)


def test_time_limit_is_kept_with_a_plan_and_a_bound():
    instance = grid(14, 6000.0)
    column_generation(instance, time_limit=1.0)  # compile
    began = perf_counter()
    result = column_generation(instance, time_limit=2.0)
    assert perf_counter() - began < 3.0
    assert result.status is Status.FEASIBLE
    assert 0 < result.bound < result.objective
    duration_is_kept(instance, result.solution)


def test_without_memory_for_any_label_memory_is_the_reason(monkeypatch):
    instance = grid(5, 800.0)
    monkeypatch.setattr("windopt.solving.exact.pricing.Pricer.capacity", lambda *_: 1)
    result = column_generation(instance)
    assert result.status is Status.FEASIBLE
    assert "memory ran out" in result.reason
    assert 0 < result.bound < result.objective
    duration_is_kept(instance, result.solution)


@pytest.mark.parametrize("memory", [1e8, 3e8])
def test_a_small_memory_leaves_a_plan_and_a_bound(memory):
    instance = grid(14, 6000.0)
    result = column_generation(instance, time_limit=2.0, memory=memory)
    assert result.status is Status.FEASIBLE
    assert "ran out" in result.reason
    assert 0 < result.bound < result.objective
    duration_is_kept(instance, result.solution)


@pytest.mark.parametrize("labels", [40, 200, 1000])
def test_too_many_labels_for_memory_leave_a_plan_and_a_bound(monkeypatch, labels):
    instance = grid(5, 800.0)
    best = column_generation(instance)
    monkeypatch.setattr("windopt.solving.exact.pricing.Pricer.capacity", lambda *_: labels)
    result = column_generation(instance, time_limit=2.0)
    assert 0 < result.bound <= best.objective + 1e-6
    assert result.objective >= best.objective - 1e-6
    duration_is_kept(instance, result.solution)


def test_lists_that_are_too_long_at_first_are_made_again(monkeypatch):
    instance = grid(5, 800.0)
    best = column_generation(instance)
    monkeypatch.setattr("windopt.solving.column_generation.EFFORT", 50)
    monkeypatch.setattr("windopt.solving.column_generation.MORE", 5.0)
    result = column_generation(instance, time_limit=60.0)
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(best.objective)


def test_no_time_at_all_still_gives_a_plan_and_a_bound():
    instance = grid(4, 900.0)
    best = column_generation(instance)
    result = column_generation(instance, time_limit=0.0)
    assert result.status is Status.FEASIBLE
    assert "time ran out" in result.reason
    assert 0 < result.bound <= best.objective <= result.objective < 1.2 * best.objective
    duration_is_kept(instance, result.solution)


def test_an_interrupt_in_the_first_moment_returns_a_plan_worth_flying(monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    instance = grid(5, 800.0)
    best = column_generation(instance)
    monkeypatch.setattr("windopt.solving.exact.first_plan.improve", interrupted)
    result = column_generation(instance)
    assert result.status is Status.INTERRUPTED
    assert 0 < result.bound <= best.objective <= result.objective < 1.2 * best.objective
    duration_is_kept(instance, result.solution)


def test_an_interrupt_returns_what_is_known():
    column_generation(grid(5, 800.0))  # compiling does not end at an interrupt
    instance = grid(14, 6000.0)
    Timer(1.0, signal.raise_signal, [signal.SIGINT]).start()
    result = column_generation(instance, time_limit=30.0)
    assert result.status is Status.INTERRUPTED
    assert result.runtime < 5.0
    assert 0 < result.bound < result.objective
    duration_is_kept(instance, result.solution)


def test_same_seed_same_plan():
    instance = grid(5, 800.0)
    first, second = (column_generation(instance, seed=3) for _ in range(2))
    assert first.solution == second.solution


def test_times_in_other_units_give_the_same_plan():
    instance = grid(5, 800.0)
    in_weeks = replace(instance, t=instance.t / 604_800, t_max=instance.t_max / 604_800)
    first, second = column_generation(instance), column_generation(in_weeks)
    assert second.objective * 604_800 == pytest.approx(first.objective)
    assert second.status is Status.OPTIMAL


def test_a_second_station_in_the_same_place_changes_nothing():
    instance = grid(5, 800.0)
    doubled = replace(
        instance,
        t=np.tile(instance.t, (2, 1, 1)),
        t_max=np.tile(instance.t_max, 2),
        stations=np.tile(instance.stations, (2, 1)),
        allowed=np.tile(instance.allowed, (2, 1)),
    )
    once, twice = column_generation(instance), column_generation(doubled)
    assert twice.objective == pytest.approx(once.objective)


def test_turbines_on_top_of_each_other_are_visited_one_after_the_other():
    instance = grid(4, 800.0)
    twice = np.r_[0, np.repeat(np.arange(1, 17), 2)]
    t = instance.t[:, twice][:, :, twice]
    turbines = np.repeat(instance.turbines, 2, axis=0)
    doubled = replace(instance, t=t, turbines=turbines, allowed=np.ones((1, 32), bool))
    once, doubly = column_generation(instance), column_generation(doubled)
    assert doubly.status is Status.OPTIMAL
    assert doubly.objective == pytest.approx(once.objective)


def test_more_than_192_turbines_are_proven():
    result = column_generation(grid(15, 560.0), time_limit=60.0)
    if result.status is Status.OPTIMAL:
        assert result.bound == pytest.approx(result.objective)


def test_a_start_is_never_made_worse():
    instance = grid(5, 800.0)
    best = column_generation(instance)
    again = column_generation(instance, start=best.solution, time_limit=0.0)
    assert again.objective == pytest.approx(best.objective)


def test_unreachable_turbines_are_named():
    instance = grid(4, 40.0)
    result = column_generation(instance)
    assert result.status is Status.INFEASIBLE
    assert "turbines 0, 1" in result.reason


def test_windopt_is_imported_without_numba():
    code = "import sys, windopt, windopt.solving; assert 'numba' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_turbine_at_the_station_takes_no_time():
    instance = RoutingInstance(
        np.zeros((1, 2, 2)), np.array([900.0]), np.zeros((1, 2)), np.zeros((1, 2)), np.zeros(2),
        np.ones((1, 1), bool),
    )  # fmt: skip
    result = column_generation(instance)
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(0.0, abs=1e-6)
