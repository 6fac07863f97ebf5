"""Closing the gap in parts, and programs that have too few flights."""

from math import inf

import numpy as np
import pytest

from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import closing
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.pool import Pool, Tree
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.subset_row_cuts import packed
from windopt.solving.exact.tightening import Selection

NO_ROWS = Rows.subsets(np.zeros((0, 3), np.int64))


def no_more_than(most, enumerate_flights, refused):
    """Return a listing that finds any gap too long but those up to ``most``, which grows."""

    def listed(networks, fixing, gap, *limits, **options):
        if gap > most * 1.4 ** len(refused):
            refused.append(gap)
            return None
        return enumerate_flights(networks, fixing, gap, *limits, **options)

    return listed


@pytest.mark.parametrize("seed", range(400, 430))
def test_parts_of_the_gap_prove_the_same_optimum(small, monkeypatch, seed):
    refused = []
    listed = no_more_than(3.0, closing.enumerate_flights, refused)
    monkeypatch.setattr(closing, "enumerate_flights", listed)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is (Status.OPTIMAL if result.solution else Status.INFEASIBLE)


def test_cuts_too_dear_leave_what_was_known_before(small, monkeypatch):
    monkeypatch.setattr("windopt.solving.exact.relaxation.WORTH", 1)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    instance = small.random_instance(7)
    result = column_generation(instance, time_limit=1.0)
    assert 0 < result.bound <= small.optimum(instance) * (1 + 1e-9) <= result.objective * (1 + 2e-9)


def pool(members, cost, station):
    """Return a pool of flights without halves."""
    m = len(cost)
    none = np.full(m, -1, np.int32)
    trees = [(Tree(none, none), Tree(none, none))] * 2
    return Pool(np.array(cost), np.array(station, np.int32), none, none, packed(members), trees)


def test_too_few_flights_for_those_that_must_be_sent_are_dear_not_impossible():
    members = np.eye(2, 3, dtype=bool)
    counts = np.array([[2.0, inf], [0.0, inf], [4.0, inf]])
    selection = Selection(3, counts, NO_ROWS, np.full(3, 50.0), 50.0)
    selection.add(pool(members, [10.0, 12.0], [0, 1]))
    with Clock(60.0) as clock:
        duals, flown = selection.solve(clock)
    assert len(flown) == 2
    assert duals.value(counts) > 50.0


def test_rows_without_a_price_may_go():
    members = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1], [1, 1, 1]], bool)
    counts = np.tile([0.0, inf], (3, 1))
    selection = Selection(3, counts, NO_ROWS, np.full(3, 50.0), 50.0)
    selection.add(pool(members, [10.0, 10.0, 10.0, 18.0], [0, 1, 0, 1]))
    with Clock(60.0) as clock:
        before = selection.solve(clock)[0].value(counts)
        selection.cut(Rows.subsets(np.array([[0, 1, 2], [0, 1, 2]])))
        duals, _ = selection.solve(clock)
        selection.keep_rows(duals.penalty > 1e-7)
        after, _ = selection.solve(clock)
    assert before == pytest.approx(15.0)
    assert selection.rows.m == len(after.penalty) == 1
    assert after.value(counts) == pytest.approx(18.0)
