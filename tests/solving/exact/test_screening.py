"""Screens leave out flights that their prices find too dear, and no others."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.master import Duals
from windopt.solving.exact.rank_one_rows import FAMILIES, Rows
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.screening import RowDuals, Screen, mixed, together_below
from windopt.solving.exact.search import Search, alone

ROWS_EACH = 9
"""Rows of each family: more in all than a word has bits."""


def random_prices(rng, n, k):
    """Return prices of turbines, stations, crowded sets and rows of all families."""
    rows = Rows.subsets(np.array([rng.permutation(n)[:3] for _ in range(ROWS_EACH)]))
    for weight, divisor in FAMILIES:
        turbines = np.array([rng.permutation(n)[:5] for _ in range(ROWS_EACH)])
        rows = rows.joined(Rows.of(turbines, weight, divisor))
    penalty = rng.choice([0.0, 1.0], rows.m) * rng.uniform(0, 30, rows.m)
    crowded = CrowdedSets(rng.random((3, n)) < 0.4, np.full(3, 2.0))
    sigma = rng.uniform(-50, 0, k + 1)
    duals = Duals(rng.uniform(0, 200, n), sigma, penalty, np.array([40.0, 0.0, 15.0]), crowded)
    return RowDuals(duals, rows)


def listing(search, **options):
    """Return all flights of a farm, as far as they are not left out."""
    search.offer(alone(search.networks))
    relaxation = Relaxation(search, 1e9, search.counts)
    relaxation.begin()
    everything = 10 * search.ceiling
    fixing = relaxation.fix_arcs(ceiling=everything)
    networks = fixing.useful(relaxation.pricer.networks, everything)
    pool, _ = enumerate_flights(networks, fixing, everything, 100_000, 1e9, search.clock, **options)
    return {(int(pool.station[r]), pool.path(r)): pool.cost[r] for r in range(len(pool))}


@pytest.mark.parametrize("apart", [False, True])
@pytest.mark.parametrize("seed", [4, 412, 432, 556])
def test_a_screen_leaves_out_what_it_finds_too_dear_and_nothing_else(small, seed, apart):
    rng = np.random.default_rng(seed)
    with Clock(60.0) as clock:
        search = Search(small.random_instance(seed, most=9), clock)
        prices = random_prices(rng, max(5, search.n), len(search.networks))
        if search.n < 5 or search.unreachable.size:
            pytest.skip("too small a farm")
        everything = listing(search, apart=True)
        costs = {
            flight: Screen(prices, 0.0).reduced_cost(*flight, time)
            for flight, time in everything.items()
        }
        limit = float(np.median(list(costs.values())))
        kept = listing(search, apart=apart, screen=Screen(prices, limit))
    wanted = {flight for flight, cost in costs.items() if cost <= limit}
    if apart:
        assert kept.keys() == wanted
    else:
        assert kept.keys() <= wanted
        assert {frozenset(path) for _, path in kept} == {frozenset(path) for _, path in wanted}


def test_a_mix_has_the_mixed_value_and_mixed_reduced_costs():
    rng = np.random.default_rng(3)
    one, other = (random_prices(rng, 8, 2) for _ in range(2))
    mix = mixed(0.3, one, other)
    counts = np.tile([2.0, 4.0], (3, 1))
    value = 0.3 * one.duals.value(counts) + 0.7 * other.duals.value(counts)
    assert mix.duals.value(counts) == pytest.approx(value)
    for path in ((0,), (3, 1, 7), (0, 1, 2, 3, 4, 5, 6, 7)):
        costs = [Screen(prices, 0.0).reduced_cost(1, path, 500.0) for prices in (one, other)]
        whole = Screen(mix, 0.0).reduced_cost(1, path, 500.0)
        assert whole == pytest.approx(0.3 * costs[0] + 0.7 * costs[1])


def test_flights_of_one_plan_fall_no_further_below_zero_than_is_said():
    members = np.array([[1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1], [1, 0, 0, 0]], bool)
    reduced = np.array([-4.0, -6.0, -2.0, -1.0])
    # Plans are {0, 2}, {1, 3} and their parts; parts of a turbine are 2, 3, 3 and 1.
    assert together_below(reduced, members) == 9.0
    assert together_below(reduced[[0, 2]], members[[0, 2]]) == 6.0
    assert together_below(reduced[:0], members[:0]) == 0.0


def test_only_penalties_above_zero_are_counted():
    rng = np.random.default_rng(5)
    prices = random_prices(rng, 8, 1)
    free = replace(prices.duals, penalty=np.zeros_like(prices.duals.penalty))
    cost = Screen(RowDuals(free, prices.rows), 0.0).reduced_cost(0, (1, 2), 100.0)
    entered = prices.duals.reward[prices.duals.crowded.sets[:, [1, 2]].any(axis=1)].sum()
    assert cost == pytest.approx(
        100.0 - prices.duals.pi[[1, 2]].sum() - prices.duals.toll[0] - entered
    )
