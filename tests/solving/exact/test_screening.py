"""Screens leave out flights that their prices find too dear, and no others."""

import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.list_prices import ListPrices, count_weights, exceeds
from windopt.solving.exact.master import Duals
from windopt.solving.exact.rank_one_rows import BITS, FAMILIES, Rows
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.row_duals import RowDuals, mixed
from windopt.solving.exact.screening import Screen, together_below
from windopt.solving.exact.search import Search, alone

ROWS_EACH = 20
"""Rows of each family: more in all than a word has bits, although half have no price."""


def random_prices(rng, n, k):
    """Return prices of turbines, stations, crowded sets and rows of all families."""
    rows = Rows.subsets(np.array([rng.permutation(n)[:3] for _ in range(ROWS_EACH)]))
    for weight, divisor in FAMILIES:
        turbines = np.array([rng.permutation(n)[:5] for _ in range(ROWS_EACH)])
        rows = rows.joined(Rows.of(turbines, weight, divisor))
    penalty = rng.choice([0.0, 1.0], rows.m) * rng.uniform(0, 30, rows.m)
    crowded = CrowdedSets(rng.random((3, n)) < 0.4, np.full(3, 2.0))
    sigma = rng.uniform(-50, 50, k + 1)
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
        costs = {flight: prices.reduced_cost(*flight, time) for flight, time in everything.items()}
        middle = sorted(costs.values())[len(costs) // 2 - 1 :][:2]
        limit = max(0.0, sum(middle) / 2)
        kept = listing(search, apart=apart, screen=Screen(prices, limit))
    wanted = {flight for flight, cost in costs.items() if cost <= limit}
    if apart:
        assert kept.keys() == wanted
    else:
        assert kept.keys() <= wanted
        assert {frozenset(path) for _, path in kept} == {frozenset(path) for _, path in wanted}


def test_a_mix_has_mixed_reduced_costs_and_no_less_than_the_mixed_value():
    rng = np.random.default_rng(3)
    one, other = (random_prices(rng, 8, 2) for _ in range(2))
    mix = mixed(0.3, one, other)
    counts = np.tile([2.0, 4.0], (3, 1))
    assert mix.duals.value(counts) >= (
        0.3 * one.duals.value(counts) + 0.7 * other.duals.value(counts) - 1e-9
    )
    for path in ((0,), (3, 1, 7), (0, 1, 2, 3, 4, 5, 6, 7)):
        costs = [prices.reduced_cost(1, path, 500.0) for prices in (one, other)]
        assert mix.reduced_cost(1, path, 500.0) == pytest.approx(0.3 * costs[0] + 0.7 * costs[1])


def test_flights_of_one_plan_fall_no_further_below_zero_than_is_said():
    members = np.array([[1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1], [1, 0, 0, 0]], bool)
    reduced = np.array([-4.0, -6.0, -2.0, -1.0])
    # Plans are {0, 2}, {1, 3} and their parts; parts of a turbine are 2, 3, 3 and 1.
    assert together_below(reduced, members) == 9.0
    assert together_below(reduced[[0, 2]], members[[0, 2]]) == 6.0
    assert together_below(reduced[:0], members[:0]) == 0.0


def test_a_limit_below_zero_is_refused():
    prices = random_prices(np.random.default_rng(0), 6, 1)
    with pytest.raises(ValueError, match=r"Expected limit >= 0, got -1\.0"):
        Screen(prices, -1.0)


def test_two_halves_pay_for_rows_what_the_flight_does():
    """Of a hundred turbines, whose sets take two words, over more rows than a word has bits."""
    rng, n = np.random.default_rng(8), 100
    prices = random_prices(rng, n, 1)
    asked = ListPrices.of(prices, n)
    assert asked.ones.shape[1] > 1
    counter = np.empty((BITS, asked.ones.shape[1]), np.uint64)
    for _ in range(200):
        chosen = rng.permutation(n)[: rng.integers(2, 60)]
        split = int(rng.integers(1, len(chosen)))
        members = np.zeros((1, n), bool)
        members[0, chosen] = True
        exact = prices.rows.coefficients(members)[0] @ prices.duals.penalty
        count_weights(asked, chosen[:split], split, counter)
        behind = chosen[split:].copy()
        for more, exceeded in ((-1e-6, True), (1e-6, False)):
            found = exceeds(asked, counter, behind, len(behind), 0.0, exact + more)
            assert found is exceeded
