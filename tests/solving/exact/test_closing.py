"""Closing the gap in parts."""

from types import SimpleNamespace

import numpy as np
import pytest

from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import closing
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
    listed = refusing_beyond(1.0, closing.enumerate_flights, refused)
    monkeypatch.setattr(closing, "enumerate_flights", listed)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    return refused


@pytest.mark.parametrize("seed", [412, 432, 444, 477, 479, 489, 556, 558, 566, 595, 866])
def test_parts_of_the_gap_prove_the_same_optimum(small, refused, seed):
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is Status.OPTIMAL
    assert refused


@pytest.mark.parametrize("seed", [412, 432, 444, 477, 479, 489, 556, 558, 566, 595, 866])
def test_prices_of_a_list_that_are_not_good_for_the_next_are_told_from_those_that_are(
    small, refused, monkeypatch, seed
):
    monkeypatch.setattr(closing, "MIX", 1.0)
    monkeypatch.setattr(closing, "SPARE", 0.0)
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=20.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is Status.OPTIMAL


def test_the_next_list_is_expected_to_grow_like_the_last():
    known = closing.Closing(SimpleNamespace(search=SimpleNamespace(n=50), memory=4e9), 0)
    assert known._affordable(1_000_000) == np.inf
    known.listed = ((10.0, 1000), (12.0, 2000))
    doublings = np.log2(closing.FILLED * closing.most_flights(50, 1_000_000, 4e9) / 2000)
    assert known._affordable(1_000_000) == pytest.approx(12.0 + 2.0 * doublings)
    assert known._affordable(1) == 12.0


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
