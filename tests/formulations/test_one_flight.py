"""What one flight can serve, against every order in which it could be flown."""

from itertools import combinations, pairwise, permutations

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


def test_crowded_sets_are_crowded_and_short_of_flights():
    t = np.full((7, 7), 100.0)  # two turbines fit into a flight
    one_flight = OneFlight(network(t, 300.0))
    x = np.zeros((7, 7))
    for i, j in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (4, 5), (5, 6), (6, 0)]:
        x[i, j] = 1.0
    assert set(one_flight.crowded_sets(x)) == {(1, 2, 3), (4, 5, 6)}
