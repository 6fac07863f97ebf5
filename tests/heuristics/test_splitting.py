"""Splitting a tour against every way to cut it, and against cases done by hand."""

from itertools import pairwise

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.heuristics.splitting import split_by_rule, split_optimally

SPLITS = [split_by_rule, split_optimally]


def times(n, seed):
    """Asymmetric times that keep the triangle inequality: distances plus a slope."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0.0, 1000.0, (n + 1, 2))
    distance = np.hypot(*(xy[:, None] - xy[None]).transpose(2, 0, 1))
    return distance + 0.3 * (xy[None, :, 0] - xy[:, None, 0])


def duration(flight, t):
    return sum(t[i, j] for i, j in pairwise((0, *(turbine + 1 for turbine in flight), 0)))


def total(flights, t):
    return sum(duration(flight, t) for flight in flights)


def all_cuts(order, t, t_max):
    """Yield the total time of every way to cut the order into flights that are short enough."""
    for mask in range(2 ** (len(order) - 1)):
        ends = [i + 1 for i in range(len(order) - 1) if mask >> i & 1] + [len(order)]
        flights = [order[a:b] for a, b in pairwise([0, *ends])]
        if all(duration(flight, t) <= t_max for flight in flights):
            yield total(flights, t)


@pytest.mark.parametrize("seed", range(20))
def test_the_optimal_split_is_the_best_of_all_cuts(seed):
    t = times(8, seed)
    t_max = 1.3 * (t[0] + t[:, 0]).max()
    order = np.random.default_rng(seed).permutation(8).tolist()
    best = min(all_cuts(order, t, t_max))
    assert total(split_optimally(order, t, t_max), t) == pytest.approx(best)


@pytest.mark.parametrize("seed", range(20))
def test_the_optimal_split_is_never_longer_than_the_rule(seed):
    t = times(30, seed)
    t_max = 1.5 * (t[0] + t[:, 0]).max()
    by_rule = split_by_rule(range(30), t, t_max)
    assert total(split_optimally(range(30), t, t_max), t) <= total(by_rule, t) + 1e-9


@pytest.mark.parametrize("split", SPLITS)
@pytest.mark.parametrize("seed", range(5))
def test_flights_keep_the_order_and_the_limit(split, seed):
    t = times(12, seed)
    t_max = 1.1 * (t[0] + t[:, 0]).max()
    order = tuple(np.random.default_rng(seed).permutation(12).tolist())
    flights = split(order, t, t_max)
    assert sum(flights, ()) == order
    assert all(duration(flight, t) <= t_max for flight in flights)


def test_the_rule_fills_the_first_flight_where_two_halves_are_shorter():
    position = np.array([0.0, 1.0, 10.0, -10.0])  # Along one line, the station at 0.
    t = np.abs(position[:, None] - position[None])
    assert split_by_rule((0, 1, 2), t, 39.0) == [(0, 1), (2,)]
    assert split_by_rule((1, 0, 2), t, 22.0) == [(1, 0), (2,)]
    near_first = np.abs(np.subtract.outer([0.0, -1.0, 10.0, 11.0], [0.0, -1.0, 10.0, 11.0]))
    assert split_by_rule((0, 1, 2), near_first, 22.5) == [(0, 1), (2,)]
    assert split_optimally((0, 1, 2), near_first, 22.5) == [(0,), (1, 2)]


@pytest.mark.parametrize("split", SPLITS)
def test_a_tour_that_fits_is_one_flight(split):
    t = times(6, seed=0)
    assert split(range(6), t, 1e6) == [(0, 1, 2, 3, 4, 5)]


@pytest.mark.parametrize("split", SPLITS)
def test_a_limit_of_one_round_trip_gives_one_flight_each(split):
    t = 2.0 * (1.0 - np.eye(4))
    assert split(range(3), t, 4.0) == [(0,), (1,), (2,)]


@pytest.mark.parametrize("split", SPLITS)
def test_a_leg_that_cannot_be_flown_is_never_flown(split):
    t = times(3, seed=0)
    t[1, 2] = np.inf
    assert split(range(3), t, 1e6) == [(0,), (1, 2)]


@pytest.mark.parametrize("split", SPLITS)
def test_no_turbines_need_no_flight(split):
    assert split((), np.zeros((1, 1)), 1.0) == []


@pytest.mark.parametrize("split", SPLITS)
def test_a_turbine_out_of_reach_is_named(split):
    with pytest.raises(InvalidInput, match="round trip to turbine 1"):
        split((0, 1), np.abs(np.subtract.outer([0.0, 1, 9], [0.0, 1, 9])), 10.0)
