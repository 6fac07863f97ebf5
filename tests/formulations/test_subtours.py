"""Separation against the sets one can see, and against all sets there are."""

from itertools import chain, combinations

import numpy as np
import pytest

from formulations.subtours import violated_sets


def cycle(x, *nodes, value=1.0):
    for i, j in zip(nodes, nodes[1:] + nodes[:1], strict=True):
        x[i, j] += value
    return x


def inflow(x, S):
    outside = [i for i in range(len(x)) if i not in S]
    return x[np.ix_(outside, S)].sum()


def test_cycles_off_the_station_are_found():
    x = cycle(cycle(cycle(np.zeros((6, 6)), 0, 1), 2, 3), 4, 5)
    assert set(violated_sets(x)) == {(2, 3), (4, 5)}


def test_flights_through_the_station_are_left_alone():
    x = cycle(cycle(np.zeros((6, 6)), 0, 1, 2), 0, 3, 4, 5)
    assert list(violated_sets(x)) == []


def test_a_fractional_subtour_that_touches_the_station_is_found():
    x = cycle(cycle(np.zeros((4, 4)), 0, 1), 2, 3, value=0.75)
    cycle(x, 0, 2, 3, value=0.25)
    assert list(violated_sets(x)) == [(2, 3)]


@pytest.mark.parametrize("seed", range(200))
def test_a_set_is_found_exactly_when_there_is_one(seed):
    """Mixtures of random permutations keep the degrees, as solutions of the relaxation do."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 8))
    x = np.zeros((n, n))
    for weight in rng.dirichlet(np.ones(3)):
        x[np.arange(n), rng.permutation(n)] += weight
    sets = [list(S) for S in chain(*(combinations(range(1, n), m) for m in range(1, n)))]
    clear = min(inflow(x, S) for S in sets) < 1 - 1e-4
    found = list(violated_sets(x))
    assert bool(found) == clear
    assert all(0 not in S and inflow(x, list(S)) < 1 for S in found)
