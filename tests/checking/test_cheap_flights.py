"""The checker's list of cheap flights against all orders of all sets of turbines."""

from itertools import pairwise, permutations

import numpy as np
import pytest

from windopt.checking import cheap_flights as cheap
from windopt.checking import tails
from windopt.checking.cheap_flights import cheap_flights
from windopt.checking.tails import TooMany
from windopt.checking.times import Times


def random_times(rng, n):
    """Return times that obey no triangle inequality, some of them infinite, some zero."""
    between = rng.uniform(3, 100, (n, n)) * (np.tri(n).T + (rng.random((n, n)) > 0.3) > 0)
    between[rng.random((n, n)) < 0.1] = np.inf
    np.fill_diagonal(between, np.inf)
    out, back = rng.uniform(0, 100, (2, n))
    return Times(out, back, between, float(rng.uniform(50, 400)))


def by_enumeration(times, prices, limit):
    """Return the least time over each set of turbines whose flight keeps both limits."""
    least = {}
    n = len(prices)
    for size in range(1, n + 1):
        for order in permutations(range(n), size):
            for each in times:
                legs = sum(each.between[i, j] for i, j in pairwise(order))
                time = each.out[order[0]] + legs + each.back[order[-1]]
                if time <= each.longest and time - prices[list(order)].sum() <= limit:
                    key = frozenset(order)
                    least[key] = min(least.get(key, np.inf), time)
    return least


def random_market(seed):
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(1, 6)), int(rng.integers(1, 3))
    prices = rng.uniform(-20, 120, n)
    near = [rng.choice(n, int(rng.integers(0, n + 1)), replace=False).tolist() for _ in range(n)]
    return [random_times(rng, n) for _ in range(k)], prices, near, float(rng.uniform(-100, 100))


@pytest.mark.parametrize("seed", range(60))
def test_no_flight_is_missed_and_none_is_invented_whatever_the_neighbours(seed):
    times, prices, near, limit = random_market(seed)
    expected = by_enumeration(times, prices, limit)
    flights = cheap_flights(times, prices, near, [limit] * len(times))
    found = {
        frozenset(np.flatnonzero(row).tolist()): time
        for row, time in zip(flights.members, flights.time, strict=True)
    }
    assert found.keys() == expected.keys()
    for key, time in expected.items():
        assert found[key] == pytest.approx(time)


def test_more_than_64_turbines_are_told_apart():
    n = 70
    times = Times(np.full(n, 10.0), np.full(n, 10.0), np.full((n, n), 5.0), 25.0)
    np.fill_diagonal(times.between, np.inf)
    flights = cheap_flights([times], np.zeros(n), [()] * n, [25.0])
    assert len(flights) == n + n * (n - 1) // 2
    assert flights.members.sum(axis=1).max() == 2


@pytest.mark.parametrize(("module", "limit"), [(tails, "MOST"), (cheap, "MOST_BEGUN")])
def test_too_many_partial_flights_are_refused(monkeypatch, module, limit):
    monkeypatch.setattr(module, limit, 20)
    rng = np.random.default_rng(1)
    xy = rng.uniform(0, 10, (9, 2))
    between = np.hypot(*(xy[:, None] - xy[None]).transpose(2, 0, 1))
    np.fill_diagonal(between, np.inf)
    times = Times(np.full(9, 10.0), np.full(9, 10.0), between, 60.0)
    with pytest.raises(TooMany):
        cheap_flights([times], np.full(9, 12.0), [range(9)] * 9, [50.0])


def test_turbines_at_one_place_may_be_flown_round_for_ever_unless_they_are_neighbours(monkeypatch):
    monkeypatch.setattr(tails, "MOST", 1000)
    between = np.array([[np.inf, 0.0], [0.0, np.inf]])
    times = Times(np.full(2, 10.0), np.full(2, 10.0), between, 60.0)
    flights = cheap_flights([times], np.full(2, 5.0), [(1,), (0,)], [20.0])
    assert sorted(flights.time) == [20.0, 20.0, 20.0]
    with pytest.raises(TooMany):
        cheap_flights([times], np.full(2, 5.0), [(), ()], [20.0])
