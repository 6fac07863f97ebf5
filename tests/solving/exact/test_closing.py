"""Closing the gap in parts."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise
from threading import Barrier
from types import SimpleNamespace

import numpy as np
import pytest

from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import branching, closing, listing, tightening
from windopt.solving.exact.clock import Clock, OutOfTime
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone
from windopt.solving.exact.subset_row_cuts import packed


def refusing_beyond(gap, enumerate_flights, refused):
    """Return a listing to which all is too long but ``gap``, and a little more each time."""

    def listed(networks, fixing, wanted, *limits, **options):
        if wanted > gap * 1.4 ** len(refused):
            refused.append(wanted)
            return None, 0
        return enumerate_flights(networks, fixing, wanted, *limits, **options)

    return listed


@pytest.fixture
def refused(monkeypatch):
    """Return the gaps that were too long to list, where no local search makes gaps small."""
    refused = []
    listed = refusing_beyond(1.0, listing.enumerate_flights, refused)
    monkeypatch.setattr(listing, "enumerate_flights", listed)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    return refused


SEEDS = [412, 432, 444, 477, 479, 489, 556, 558, 566, 595, 866]


@pytest.fixture
def always_tightened(monkeypatch):
    """Add rows over lists of any size, and keep programs small, as for long lists."""
    monkeypatch.setattr(closing, "SMALL", 0)
    monkeypatch.setattr(branching, "SMALL", 0)
    monkeypatch.setattr(tightening, "FIRST", 20)


@pytest.mark.parametrize("seed", SEEDS)
def test_parts_of_the_gap_prove_the_same_optimum(small, refused, always_tightened, seed):
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is Status.OPTIMAL
    assert refused


@pytest.fixture
def branches(monkeypatch):
    """Tell what is left of each branch, where lists are branched on at once and HiGHS has none."""
    told = []
    tightened = branching._tightened

    def telling(*given):
        left = tightened(*given)
        told.append([len(child.pool) for child, _ in left])
        return left

    monkeypatch.setattr(branching, "MOST", -1)
    monkeypatch.setattr(branching, "_tightened", telling)
    monkeypatch.setattr(tightening, "ROUNDS", 1)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    return told


def test_branching_alone_proves_the_same_optimum(small, always_tightened, branches):
    for seed in range(300, 400):
        instance = small.random_instance(seed)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.bound == pytest.approx(result.objective, rel=1e-6)
    assert any(len(left) == 2 and min(left) > 0 for left in branches)


def test_the_lesser_bound_of_two_branches_stays_where_time_runs_out(small, monkeypatch):
    both_begun = Barrier(2)

    def out_of_time(pool, reduced, rows, counts, target, search, prove, few):
        prove(counts)
        both_begun.wait(60.0)
        raise OutOfTime

    monkeypatch.setattr(branching, "tighten", out_of_time)
    proved = []
    with Clock(60.0) as clock:
        clock.leaders = ThreadPoolExecutor(2)
        search = Search(small.random_instance(412), clock)
        none = np.zeros(0, np.int32)
        pool = Pool(np.zeros(0), none, none, none, packed(np.zeros((0, search.n), bool)), [])
        both = [branching.Branch(branching.everything, bound) for bound in (13.0, 11.0)]
        with pytest.raises(OutOfTime):
            branching._tightened(both, pool, pool.cost, None, 20.0, search, proved.append)
    assert proved == [11.0]


@pytest.fixture
def in_parts(small, monkeypatch):
    """Return a search whose gap can be closed in parts, a second each, and the parts."""
    parts, took = [], []

    def within(closing, delta, fixing, effort):
        parts.append(delta)
        took.append(1.0)
        closing.search.prove(fixing.value + delta)
        closing.listed += (listing.Size(delta, 100 * 4 ** len(parts), 1),)
        return True

    monkeypatch.setattr(Clock, "elapsed", property(lambda clock: sum(took)))
    monkeypatch.setattr(closing.Closing, "_search_within", within)
    with Clock(60.0) as clock:
        search = Search(small.random_instance(412), clock)
        search.offer(alone(search.networks))
        relaxation = SimpleNamespace(search=search, memory=1e9)
        yield closing.Closing(relaxation, 0), SimpleNamespace(value=search.bound), parts


def test_parts_grow_until_they_are_the_whole(in_parts):
    search, fixing, parts = in_parts
    ahead = []
    search.between = ahead.append
    assert search._close_parts(fixing, 1_000_000)
    assert ahead[0] == 1.0
    longer = (parts[2] - parts[1]) / (parts[1] - parts[0])
    assert ahead[1] == pytest.approx(4.0**longer)
    assert len(ahead) == len(parts) - 1
    assert parts[-1] == pytest.approx(search.search.objective - fixing.value)
    assert len(parts) > 2


def test_parts_are_left_where_cuts_raise_the_bound_much_faster(in_parts):
    search, fixing, parts = in_parts
    search.by_cuts = 3.0 * (search.search.objective - fixing.value)
    assert not search._close_parts(fixing, 1_000_000)
    assert len(parts) == 1


def test_no_part_is_expected_to_take_much_of_the_time_left(in_parts):
    search, fixing, parts = in_parts
    search.search.clock.limit = 4.0
    assert not search._close_parts(fixing, 1_000_000)
    less, more, last = parts[:3]
    expected = np.log(closing.SHARE * (4.0 - 2.0)) / np.log(4.0)
    assert last == pytest.approx(more + expected * (more - less), abs=1e-6)
    assert last < search.search.objective - fixing.value


def test_no_time_left_is_the_end_of_it(in_parts):
    search, fixing, parts = in_parts
    search.search.clock.limit = 2.0
    with pytest.raises(OutOfTime):
        search._close_parts(fixing, 1_000_000)
    assert len(parts) == 2


@pytest.fixture
def lists(monkeypatch):
    """Tell of each list: its fixing, its reduced cost and the limit of its screen."""
    told = []
    enumerate_flights = listing.enumerate_flights

    def listed(networks, fixing, delta, *given, screen=None, **options):
        told.append((fixing, delta, 0.0 if screen is None else screen.limit))
        return enumerate_flights(networks, fixing, delta, *given, screen=screen, **options)

    monkeypatch.setattr(listing, "enumerate_flights", listed)
    return told


@pytest.mark.parametrize("most", [600.0, 3000.0])
def test_parts_of_the_gap_prove_the_same_optimum_where_turbines_may_be_left_out(
    small, refused, lists, always_tightened, most
):
    rng = np.random.default_rng(7)
    for seed in SEEDS:
        instance = small.random_instance(seed)
        prize = rng.uniform(100.0, most, len(instance.turbines))
        flights = np.full(len(instance.t), 2.0)
        instance = replace(instance, prize=prize, max_flights=flights)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.status is Status.OPTIMAL
    assert refused
    assert any(limit > 0.0 for *_, limit in lists)


def test_lists_are_made_again_where_the_prices_of_the_last_leave_out_too_much(
    small, refused, lists, always_tightened, monkeypatch
):
    monkeypatch.setattr(listing, "MIX", 1.0)
    monkeypatch.setattr(listing, "SPARE", 1e-3)
    for seed in SEEDS:
        instance = small.random_instance(seed)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.status is Status.OPTIMAL
    assert any(
        one is other and delta == the_same and 0.0 < limit < wider
        for (one, delta, limit), (other, the_same, wider) in pairwise(lists)
    )


def test_cuts_that_make_too_many_labels_leave_what_was_known_before(small, refused, monkeypatch):
    overfull = []
    cut = Relaxation.cut
    monkeypatch.setattr(
        Relaxation, "cut", lambda self, most: (cut(self, 1), overfull.append(self.overfull))[0]
    )
    for seed in (412, 479, 489, 558, 566, 595):
        instance = small.random_instance(seed)
        result = column_generation(instance, time_limit=5.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert any(overfull)


def test_rows_that_were_too_many_may_make_more_labels_later(small):
    with Clock(60.0) as clock:
        search = Search(small.random_instance(412), clock)
        relaxation = Relaxation(search, 1e9, search.counts)
        worth = relaxation.worth
        relaxation.relent()
        assert (relaxation.worth, relaxation.overfull) == (worth, False)
        relaxation.overfull = True
        relaxation.relent()
        assert (relaxation.worth, relaxation.overfull) == (2 * worth, False)
