"""Set partitioning over all flights of small farms."""

from itertools import pairwise, permutations

import highspy
import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from formulations.set_partitioning import set_partitioning

FREE = np.array([[0.0, highspy.kHighsInf]] * 2)


def square():
    """Return times between a station and four turbines at the corners of a square around it."""
    xy = np.array([[0, 0], [1, 1], [-1, 1], [-1, -1], [1, -1]], float)
    return np.hypot(*(xy[:, None] - xy[None]).T)


def all_flights(t, t_max):
    """Return time and set of the fastest flight over each set of turbines."""
    n = len(t) - 1
    best = {}
    for size in range(1, n + 1):
        for path in permutations(range(1, n + 1), size):
            nodes = (0, *path, 0)
            time = sum(t[i, j] for i, j in pairwise(nodes))
            if time <= t_max:
                key = tuple(sorted(path))
                best[key] = min(best.get(key, np.inf), time)
    return best


def solved(t, t_max, counts=FREE, rows=(), crowded=(), **options):
    """Return the optimum over all flights.

    There are subset rows for the triples ``rows``, and two flights enter each set in ``crowded``.
    """
    flights = all_flights(t, t_max)
    n = len(t) - 1
    program = set_partitioning(n, counts, **options)
    before = program.model.getNumCol()
    left_out = [[2.0 * (i in row) for i in range(1, before + 1)] for row in crowded]
    left_out = csr_array(np.reshape(left_out, (len(crowded), before)))
    program.add_entry_rows(left_out, np.full(len(crowded), 2.0))
    program.add_subset_rows(csr_array((len(rows), before)))
    visits = np.array([[i in flight for flight in flights] for i in range(1, n + 1)], float)
    entered = [[bool(set(row) & set(flight)) for flight in flights] for row in crowded]
    cut = [[len(set(row) & set(flight)) // 2 for flight in flights] for row in rows]
    both = [np.reshape(each, (len(each), len(flights))) for each in (entered, cut)]
    a = np.vstack([visits, np.ones((2, len(flights))), *both])
    program.add_flights(np.array(list(flights.values())), csc_array(a))
    program.model.run()
    assert program.model.getModelStatus() == highspy.HighsModelStatus.kOptimal
    return program.model.getInfo().objective_function_value


def test_one_flight_around_the_square():
    assert solved(square(), 100.0) == pytest.approx(6 + 2 * np.sqrt(2))


def test_two_turbines_a_flight_when_time_is_short():
    assert solved(square(), 5.0) == pytest.approx(2 * (2 + 2 * np.sqrt(2)))


def test_as_many_flights_as_asked_for():
    three = np.array([[0.0, highspy.kHighsInf], [3.0, 3.0]])
    at_least_three = solved(square(), 100.0, three)
    assert at_least_three == pytest.approx(2 + 2 * np.sqrt(2) + 4 * np.sqrt(2))


def test_turbines_dearer_than_their_price_are_left_out():
    assert solved(square(), 100.0, price=0.5) == pytest.approx(2.0)


def test_a_subset_row_cuts_off_half_flights():
    angle = 2 * np.pi * np.arange(3) / 3  # each pair of the three fits a flight, all do not
    xy = np.vstack([np.zeros(2), np.c_[np.cos(angle), np.sin(angle)]])
    t = np.hypot(*(xy[:, None] - xy[None]).T)
    pair, alone = 2 + np.sqrt(3), 2.0
    assert solved(t, 4.0, integer=False) == pytest.approx(1.5 * pair)
    assert solved(t, 4.0, rows=[(1, 2, 3)], integer=False) == pytest.approx(pair + alone)


def test_two_flights_enter_a_set_that_one_cannot_serve():
    angle = 2 * np.pi * np.arange(3) / 3
    xy = np.vstack([np.zeros(2), np.c_[np.cos(angle), np.sin(angle)]])
    t = np.hypot(*(xy[:, None] - xy[None]).T)
    whole = solved(t, 4.0)
    assert solved(t, 4.0, crowded=[(1, 2, 3)], integer=False) == pytest.approx(whole)
    left_out = solved(t, 4.0, crowded=[(1, 2, 3)], integer=False, price=1e-3)
    assert left_out == pytest.approx(3e-3)


def test_the_relaxation_never_exceeds_the_optimum():
    rng = np.random.default_rng(0)
    for _ in range(20):
        xy = rng.uniform(0, 1, (6, 2))
        t = np.hypot(*(xy[:, None] - xy[None]).T)
        t_max = 2.3 * t[0].max()
        assert solved(t, t_max, integer=False) <= solved(t, t_max) + 1e-9
        assert solved(t, t_max, integer=False, cover=True) <= solved(t, t_max) + 1e-9
