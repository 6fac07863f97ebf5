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
