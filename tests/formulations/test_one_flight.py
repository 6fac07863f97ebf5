"""What one flight can serve, against every order in which it could be flown."""

from itertools import combinations, pairwise, permutations, product

import numpy as np
import pytest

from formulations.network import network
from formulations.one_flight import OneFlight


@pytest.mark.parametrize("seed", range(20))
def test_a_set_is_served_exactly_when_some_order_is_short_enough(seed, routing):
    t, t_max, allowed = routing.random_instance(seed, turbines=5, stations=2)
    one_flight = OneFlight(network(t, t_max, allowed))
    n = t.shape[1] - 1
    for size in range(1, n + 1):
        for S in combinations(range(1, n + 1), size):
            expected = any(
                sum(t[d, i, j] for i, j in pairwise((0, *order, 0))) <= t_max[d] * (1 + 1e-9)
                for d in range(len(t))
                if allowed[d, np.array(S) - 1].all()
                for order in permutations(S)
            )
            assert one_flight.serves(S) == expected


@pytest.mark.parametrize("times", ["wind", "paper", "any"])
@pytest.mark.parametrize("seed", range(20))
def test_a_set_within_a_flight_that_is_short_enough_is_served(seed, times, routing):
    """Also where the flight passes other turbines before, between and after those of the set."""
    t, t_max, allowed = routing.instances[times](seed, turbines=5, stations=2)
    one_flight = OneFlight(network(t, t_max, allowed))
    n = t.shape[1] - 1
    for size in range(1, n + 1):
        for d, order in product(range(len(t)), permutations(range(1, n + 1), size)):
            duration = sum(t[d, i, j] for i, j in pairwise((0, *order, 0)))
            if allowed[d, np.array(order) - 1].all() and duration <= t_max[d]:
                for part in range(1, size + 1):
                    assert all(one_flight.serves(S) for S in combinations(sorted(order), part))


def test_a_turbine_reached_sooner_over_another_is_served():
    """The leg to turbine 1 takes as long as the flight may, the way over turbine 2 does not."""
    t = np.array([[0.0, 300.0, 100.0], [100.0, 0.0, 100.0], [100.0, 100.0, 0.0]])
    assert OneFlight(network(t, 300.0)).serves((1,))


def test_crowded_sets_are_crowded_and_short_of_flights():
    t = np.full((7, 7), 100.0)  # two turbines fit into a flight
    one_flight = OneFlight(network(t, 300.0))
    x = np.zeros((7, 7))
    for i, j in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 6), (6, 0)]:
        x[i, j] = 1.0
    assert set(one_flight.crowded_sets(x)) == {(1, 2, 3), (4, 5, 6)}
