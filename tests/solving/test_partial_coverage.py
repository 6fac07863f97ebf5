"""Plans that leave turbines out: few flights and prizes, against all subsets of turbines."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.result import Status
from windopt.solving.column_generation import column_generation


def with_prizes(instance, seed):
    """Return the instance with prizes, of the size of a flight or far above, and few flights."""
    rng = np.random.default_rng([seed, 1])
    k, n = instance.allowed.shape
    trips = np.where(np.isfinite(instance.round_trip), instance.round_trip, 0.0)
    prize = rng.uniform(0.0, 1.2, n) * trips.mean()
    if rng.random() < 0.5:
        prize = rng.integers(1, 4, n) * (1.0 + n * instance.t_max.sum())
    few = rng.choice([0.0, 1.0, 2.0, np.inf], k, p=[0.1, 0.4, 0.3, 0.2])
    return replace(instance, prize=prize, max_flights=few if rng.random() < 0.8 else None)


def keeps_its_limits(instance, routes):
    for route in routes:
        assert instance.duration(route) <= instance.t_max[route.station] * (1 + 1e-9)
        assert instance.allowed[route.station, list(route.turbines)].all()
    visited = [i for route in routes for i in route.turbines]
    assert len(set(visited)) == len(visited)
    sent = np.bincount([route.station for route in routes], minlength=len(instance.t))
    assert instance.max_flights is None or (sent <= instance.max_flights).all()


def agrees(instance, optimum):
    result = column_generation(instance)
    assert result.status is Status.OPTIMAL
    assert result.objective == pytest.approx(optimum, rel=1e-9, abs=1e-6)
    assert result.bound == pytest.approx(optimum, rel=1e-8, abs=1e-6)
    assert instance.cost(result.solution) == pytest.approx(optimum, rel=1e-9, abs=1e-6)
    keeps_its_limits(instance, result.solution)


@pytest.mark.parametrize("seed", range(100))
def test_optimum_equals_enumeration(small, seed):
    instance = with_prizes(small.random_instance(seed, most=7), seed)
    agrees(instance, small.optimum(instance))


@pytest.mark.slow
def test_optimum_equals_enumeration_on_many_more(small):
    for seed in range(3000, 4000):
        instance = with_prizes(small.random_instance(seed, most=8), seed)
        agrees(instance, small.optimum(instance))


@pytest.mark.parametrize("seed", range(200, 220))
def test_branching_finds_the_same_optimum(small, monkeypatch, seed):
    monkeypatch.setattr("windopt.solving.exact.staged_mip.SIZES", (1,))
    monkeypatch.setattr("windopt.solving.exact.tightening.ROUNDS", 1)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    instance = with_prizes(small.random_instance(seed, most=7), seed)
    agrees(instance, small.optimum(instance))


def test_prizes_above_any_flight_leave_nothing_out(small):
    instance = small.random_instance(4)
    prized = replace(instance, prize=np.full(len(instance.turbines), 1e5))
    every, worth = column_generation(instance), column_generation(prized)
    assert worth.objective == pytest.approx(every.objective)


def test_one_more_flight_never_costs_more(small):
    instance = with_prizes(small.random_instance(7), 7)
    k = len(instance.t)
    costs = [
        column_generation(replace(instance, max_flights=np.full(k, most))).objective
        for most in (0.0, 1.0, 2.0, 3.0, np.inf)
    ]
    assert costs[0] == pytest.approx(instance.prize.sum())
    assert costs == sorted(costs, reverse=True)


def test_few_flights_ask_for_prizes(small):
    instance = small.random_instance(0)
    with pytest.raises(InvalidInput, match="prize where flights are limited"):
        replace(instance, max_flights=np.ones(len(instance.t)))


@pytest.mark.parametrize("prize", [-1.0, np.nan, np.inf])
def test_prizes_are_finite(small, prize):
    instance = small.random_instance(0)
    with pytest.raises(InvalidInput, match="prize >= 0 and finite"):
        replace(instance, prize=np.full(len(instance.turbines), prize))
