"""Closing the gap in parts."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import listing, tightening
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search
from windopt.solving.exact.selection import Selection


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
    monkeypatch.setattr(tightening, "SMALL", 0)
    monkeypatch.setattr(tightening, "FIRST", 20)


@pytest.mark.parametrize("seed", SEEDS)
def test_parts_of_the_gap_prove_the_same_optimum(small, refused, always_tightened, seed):
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is Status.OPTIMAL
    assert refused


@pytest.mark.parametrize("worth", ["little", "much"])
def test_parts_of_the_gap_prove_the_same_optimum_where_turbines_may_be_left_out(
    small, refused, always_tightened, worth
):
    rng = np.random.default_rng(7)
    for seed in SEEDS:
        instance = small.random_instance(seed)
        most = {"little": 600.0, "much": 3000.0}[worth]
        prize = rng.uniform(100.0, most, len(instance.turbines))
        flights = np.full(len(instance.t), 2.0)
        instance = replace(instance, prize=prize, max_flights=flights)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.status is Status.OPTIMAL


def test_lists_are_made_again_where_the_prices_of_the_last_leave_out_too_much(
    small, refused, always_tightened, monkeypatch
):
    monkeypatch.setattr(listing, "MIX", 1.0)
    monkeypatch.setattr(listing, "SPARE", 1e-3)
    limits = []
    enumerate_flights = listing.enumerate_flights

    def told(*given, screen=None, **options):
        limits.append(0.0 if screen is None else screen.limit)
        return enumerate_flights(*given, screen=screen, **options)

    monkeypatch.setattr(listing, "enumerate_flights", told)
    for seed in SEEDS:
        instance = small.random_instance(seed)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.status is Status.OPTIMAL
    assert any(0.0 < limit < again for limit, again in pairwise(limits))


def test_flights_that_left_the_program_over_a_list_return(small, monkeypatch):
    monkeypatch.setattr(tightening, "NEAR", 0.0)
    monkeypatch.setattr(tightening, "SMALL", 0)
    programs = []
    add = Selection.add
    monkeypatch.setattr(
        Selection, "add", lambda self, pool: (programs.append(self), add(self, pool))[1]
    )
    for seed in SEEDS:
        instance = small.random_instance(seed)
        result = column_generation(instance, time_limit=20.0)
        assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
        assert result.status is Status.OPTIMAL
    assert len(programs) > len({id(program) for program in programs})


def test_the_next_list_is_expected_to_grow_like_the_last():
    few, more = listing.Size(10.0, 1000, 500), listing.Size(12.0, 2000, 800)
    assert listing.affordable((few,), 1e6, 1e6) == np.inf
    assert listing.affordable((few, more), 1e9, 8000.0) == pytest.approx(16.0)
    doublings = np.log2(3200.0 / 800.0) / np.log2(800.0 / 500.0)
    assert listing.affordable((few, more), 3200.0, 1e9) == pytest.approx(12.0 + 2.0 * doublings)
    assert listing.affordable((few, more), 1.0, 1.0) == 12.0


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
