"""Rank-one rows against their definition, and separation on plans known to violate them."""

from itertools import combinations

import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.rank_one_rows import FAMILIES, Rows, reaching, violated_rows
from windopt.solving.exact.subset_row_cuts import packed

THREE = ((1, 1, 1), 2)


def partition(rng, n):
    """Return a random plan: whether each flight visits each turbine."""
    flight = rng.integers(0, int(rng.integers(1, n + 1)), n)
    return np.array([flight == r for r in np.unique(flight)])


def random_rows(rng, n, family):
    weight, divisor = family
    turbines = np.array([rng.permutation(n)[: len(weight)] for _ in range(20)])
    return Rows.of(turbines, weight, divisor)


@pytest.mark.parametrize("family", [THREE, *FAMILIES])
def test_every_plan_keeps_every_row(family):
    rng = np.random.default_rng(0)
    for _ in range(100):
        rows = random_rows(rng, 9, family)
        assert (rows.coefficients(partition(rng, 9)).sum(axis=0) <= 1 + 1e-9).all()


@pytest.mark.parametrize("family", [THREE, *FAMILIES])
def test_bits_of_64_flights_count_as_one_by_one(family):
    rng = np.random.default_rng(1)
    members = rng.random((64, 9)) < 0.5
    rows = random_rows(rng, 9, family)
    slices = packed(np.ascontiguousarray(members.T))
    wanted = rows.coefficients(members) * rows.right
    for row in range(rows.m):
        reached = np.zeros(64)
        for level in range(1, int(rows.right[row]) + 1):
            bits = int(reaching(slices, 0, rows, row, level))
            reached += [bits >> flight & 1 for flight in range(64)]
        assert reached == pytest.approx(wanted[:, row])


def test_a_ring_of_five_halves_is_cut_off():
    members = np.zeros((5, 7), bool)
    for i in range(5):
        members[i, [i, (i + 1) % 5]] = True
    with Clock(600.0) as clock:
        rows, violation = violated_rows(members, np.full(5, 0.5), 0.1, clock)
    assert violation.max() == pytest.approx(0.25)
    assert rows.coefficients(members)[:, violation.argmax()].sum() * 0.5 == pytest.approx(1.25)


def test_all_pairs_of_four_and_a_triple_violate_a_row_of_four():
    members = np.array(
        [[True, False, False, False, i == j] for i, j in [(0, 0), (1, 2), (3, 4)]]
        + [[False, True, True, True, False]]
    )
    for r, j in enumerate((1, 2, 3)):
        members[r, j] = True
    x = np.array([1 / 3, 1 / 3, 1 / 3, 2 / 3])
    with Clock(600.0) as clock:
        _, violation = violated_rows(members, x, 0.1, clock)
    assert violation.max() == pytest.approx(2 / 3)


def test_whole_plans_violate_nothing():
    rng = np.random.default_rng(2)
    with Clock(600.0) as clock:
        for _ in range(5):
            members = partition(rng, 8)
            rows, _ = violated_rows(members, np.ones(len(members)), 1e-6, clock)
            assert rows.m == 0


def test_what_is_found_is_violated_as_it_claims():
    rng = np.random.default_rng(3)
    members = np.array([np.isin(np.arange(6), pair) for pair in combinations(range(6), 3)])
    x = rng.random(len(members))
    x /= (members * x[:, None]).sum(axis=0).max()
    with Clock(600.0) as clock:
        rows, violation = violated_rows(members, x, 0.01, clock)
    assert rows.coefficients(members).T @ x - 1.0 == pytest.approx(violation)
