"""Savings: plans at once, that keep every limit."""

import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.savings import savings
from windopt.solving.exact.search import Search, alone


def time_of(networks, flights):
    return sum(networks[d].duration(path) for d, path in flights)


@pytest.fixture(params=range(50))
def search(request, small):
    """Return a search of a random instance, of the turbines within reach."""
    instance = small.random_instance(request.param)
    reached = np.flatnonzero(instance.reachable.any(axis=0))
    return Search(instance.subset(reached.tolist()), Clock(600.0))


def test_every_turbine_is_visited_once_in_time(search):
    flights = savings(search.networks, search.counts[:-1, 1], search.prize)
    assert sorted(i for _, path in flights for i in path) == list(range(search.n))
    for d, path in flights:
        assert search.networks[d].duration(path) <= search.networks[d].t_max + 1e-6


def test_a_plan_takes_no_longer_than_flights_to_one_turbine_each(search):
    flights = savings(search.networks, search.counts[:-1, 1], search.prize)
    single = alone(search.networks)
    assert time_of(search.networks, flights) <= time_of(search.networks, single) + 1e-6


def test_few_flights_are_spent_on_what_is_worth_most(search):
    most, prize = np.ones(len(search.networks)), np.full(search.n, 1e5)
    flights = savings(search.networks, most, prize)
    every = savings(search.networks, search.counts[:-1, 1], prize)
    for d in range(len(search.networks)):
        kept, sizes = ([len(path) for e, path in plan if e == d] for plan in (flights, every))
        assert kept == sorted(sizes)[-1:]


def test_a_turbine_worth_less_than_its_flight_is_left_out(search):
    flights = savings(search.networks, search.counts[:-1, 1], np.zeros(search.n))
    assert flights == []
