"""The closed tour against enumeration and against known tours."""

from itertools import pairwise, permutations

import numpy as np
import pytest

from formulations.tour import tour
from windopt.result import Status
from windopt.solving.integer import solve


@pytest.mark.parametrize("seed", range(20))
def test_optimum_equals_enumeration(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 7))
    t = rng.uniform(1, 100, (n + 1, n + 1))
    orders = permutations(range(1, n + 1))
    expected = min(sum(t[i, j] for i, j in pairwise((0, *order, 0))) for order in orders)
    assert solve(tour(t)).objective == pytest.approx(expected)


def test_the_tour_of_a_regular_polygon_is_its_perimeter():
    angle = 2 * np.pi * np.arange(30) / 30
    xy = np.c_[np.cos(angle), np.sin(angle)]
    program = tour(np.hypot(*(xy[:, None] - xy[None]).T))
    result = solve(program)
    assert result.objective == pytest.approx(30 * 2 * np.sin(np.pi / 30))
    [(station, order)] = program.routes(result.solution)
    assert station == 0
    assert order in (tuple(range(29)), tuple(reversed(range(29))))


def test_clusters_far_apart_are_joined_in_one_tour():
    rng = np.random.default_rng(0)
    centre = np.repeat([[0, 0], [100, 0], [0, 100], [100, 100]], 5, axis=0)
    xy = centre + rng.uniform(0, 1, (20, 2))
    program = tour(np.hypot(*(xy[:, None] - xy[None]).T))
    result = solve(program)
    assert result.status is Status.OPTIMAL
    assert 396 < result.objective < 420
    assert sorted(program.routes(result.solution)[0][1]) == list(range(19))


def test_a_leg_that_cannot_be_flown_is_avoided():
    t = np.ones((4, 4))
    t[0, 1] = t[1, 2] = np.inf
    program = tour(t)
    assert program.routes(solve(program).solution)[0][1][0] != 0


def test_a_turbine_that_cannot_be_left_makes_it_infeasible():
    t = np.ones((4, 4))
    t[2] = np.inf
    assert solve(tour(t)).status is Status.INFEASIBLE
