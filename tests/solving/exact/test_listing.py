"""Lists: how long the next will be, and what must be in each."""

from types import SimpleNamespace

import numpy as np
import pytest

from windopt.solving.exact import listing
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import ProofError, Search, alone


def test_the_next_list_is_expected_to_grow_like_the_last():
    few, more = listing.Size(10.0, 1000, 500), listing.Size(12.0, 2000, 800)
    assert listing.affordable((few,), 1e6, 1e6) == np.inf
    assert listing.affordable((few, more), 1e9, 8000.0) == pytest.approx(16.0)
    doublings = np.log2(3200.0 / 800.0) / np.log2(800.0 / 500.0)
    assert listing.affordable((few, more), 3200.0, 1e9) == pytest.approx(12.0 + 2.0 * doublings)
    assert listing.affordable((few, more), 1.0, 1.0) == 12.0


@pytest.fixture
def setting(small):
    """Return a search that knows a plan, its relaxation, and what that tells of all flights."""
    with Clock(60.0) as clock:
        search = Search(small.random_instance(412), clock)
        search.offer(alone(search.networks))
        relaxation = Relaxation(search, 1e9, search.counts)
        relaxation.begin()
        yield search, relaxation, relaxation.fix_arcs()


def test_a_flight_of_the_best_plan_that_is_missing_is_a_mistake(setting, monkeypatch):
    search, relaxation, fixing = setting
    gap = search.ceiling - fixing.value
    whole = listing.list_flights(relaxation, fixing, gap, 100_000, None)
    assert whole is not None
    enumerate_flights = listing.enumerate_flights

    def forgetful(*given, **options):
        pool, pairs = enumerate_flights(*given, **options)
        alone = search.flights[0][1][0]
        return pool.kept(~pool.members(search.n)[:, alone]), pairs

    monkeypatch.setattr(listing, "enumerate_flights", forgetful)
    with pytest.raises(ProofError, match="not in the pool"):
        listing.list_flights(relaxation, fixing, gap, 100_000, None)


def test_prices_that_prove_more_than_the_best_plan_takes_are_a_mistake(setting, monkeypatch):
    search, relaxation, fixing = setting
    gap = search.ceiling - fixing.value
    assert listing.list_flights(relaxation, fixing, gap, 100_000, fixing.in_full) is not None
    monkeypatch.setattr(type(fixing.duals), "value", lambda duals, counts: 2.0 * search.objective)
    with pytest.raises(ProofError, match="prove more"):
        listing.list_flights(relaxation, fixing, gap, 100_000, fixing.in_full)


def test_pairs_of_halves_are_limited_where_flights_are_screened(setting, monkeypatch):
    search, relaxation, fixing = setting
    gap = search.ceiling - fixing.value
    monkeypatch.setattr("windopt.solving.exact.enumeration.PAIRS", 0)
    assert listing.list_flights(relaxation, fixing, gap, 100_000, None) is not None
    assert listing.list_flights(relaxation, fixing, gap, 100_000, fixing.in_full) is None


def test_no_size_is_zero():
    empty = listing.Listing(SimpleNamespace(__len__=lambda _: 0), 0)
    assert empty._replace(pool=()).size(3.0) == (3.0, 1, 1)
