"""The linear program over some flights of a pool."""

from math import inf

import highspy
import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.pool import Pool, Tree, reduced_costs
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.selection import Selection
from windopt.solving.exact.subset_row_cuts import packed


def pool(members, cost, station):
    """Return a pool of flights without halves."""
    m = len(cost)
    none = np.full(m, -1, np.int32)
    trees = [(Tree(none, none), Tree(none, none))] * 2
    return Pool(np.array(cost), np.array(station, np.int32), none, none, packed(members), trees)


def test_flights_that_must_be_sent_and_are_lacking_are_dear_not_impossible():
    counts = np.array([[0.0, inf], [0.0, inf], [2.0, inf]])
    once = Rows.subsets(np.array([[0, 1, 2]]))
    selection = Selection(3, counts, once, np.full(3, 50.0), 50.0, CrowdedSets.none(3))
    selection.add(pool(np.ones((1, 3), bool), [10.0], [0]))
    with Clock(60.0) as clock:
        duals, flown = selection.solve(clock)
    assert flown[:2].sum() == pytest.approx(1.0)  # idle
    assert flown[2] == pytest.approx(1.0)
    assert duals.value(counts) == pytest.approx(60.0)


def test_a_crowded_set_is_entered_as_often_as_it_needs():
    members = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1], [0, 0, 1]], bool)
    counts = np.tile([0.0, inf], (3, 1))
    none = Rows.subsets(np.zeros((0, 3), np.int64))
    crowded = CrowdedSets(np.ones((1, 3), bool), np.array([2.0]))
    selection = Selection(3, counts, none, np.full(3, 50.0), 50.0, crowded)
    flights = pool(members, [10.0, 10.0, 10.0, 8.0], [0, 1, 0, 1])
    selection.add(flights)
    with Clock(60.0) as clock:
        duals, flown = selection.solve(clock)
        slices = flights.slices(3, clock)
        reduced = reduced_costs(flights, slices, duals, none, clock)
    assert flown.sum() == pytest.approx(2.0)
    assert duals.value(counts) == pytest.approx(18.0)
    assert duals.reward[0] > 0
    assert reduced.min() == pytest.approx(0.0)
    assert reduced[flown[2:] > 1e-9] == pytest.approx(0.0)


def three_pairs_and_all():
    """Return a program over flights to each two of three turbines and to all, and its counts."""
    members = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1], [1, 1, 1]], bool)
    counts = np.tile([0.0, inf], (3, 1))
    none = Rows.subsets(np.zeros((0, 3), np.int64))
    selection = Selection(3, counts, none, np.full(3, 50.0), 50.0, CrowdedSets.none(3))
    selection.add(pool(members, [10.0, 10.0, 10.0, 18.0], [0, 1, 0, 1]))
    return selection, counts


def test_rows_without_a_price_may_go():
    selection, counts = three_pairs_and_all()
    with Clock(60.0) as clock:
        before = selection.solve(clock)[0].value(counts)
        selection.cut(Rows.subsets(np.array([[0, 1, 2], [0, 1, 2]])))
        duals, _ = selection.solve(clock)
        selection.keep_rows(duals.penalty > 1e-7)
        after, _ = selection.solve(clock)
    assert before == pytest.approx(15.0)
    assert selection.rows.m == len(after.penalty) == 1
    assert after.value(counts) == pytest.approx(18.0)


def test_branches_are_probed_and_leave_no_trace():
    selection, counts = three_pairs_and_all()
    one = counts.copy()
    one[-1, 1] = 1.0
    keep = np.ones(len(selection.members), bool)
    without = keep.copy()
    without[2] = False  # after two idle flights
    with Clock(60.0) as clock:
        before = selection.solve(clock)[0].value(counts)
        assert selection.value_with(keep, one, 100, clock) == pytest.approx(18.0)
        assert selection.value_with(without, counts, 100, clock) == pytest.approx(18.0)
        assert selection.value_with(without, counts, 0, clock) == pytest.approx(15.0)
        assert selection.value_with(keep, counts, 100, clock) == pytest.approx(15.0)
        after = selection.solve(clock)[0].value(counts)
        assert before == after == pytest.approx(15.0)
        limit = selection._program.model.getOptionValue("simplex_iteration_limit")[1]
        assert limit == highspy.kHighsIInf
