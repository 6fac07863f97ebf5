"""Which turbines need several flights, against all plans of small farms."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import crowding
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.crowding import Crowding
from windopt.solving.exact.network import networks
from windopt.solving.exact.pricing import Pricer
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone


def fewest_flights(small, instance, inside):
    """Return how many flights serve the turbines ``inside`` at least."""
    each = zip(instance.t, instance.t_max, instance.allowed, strict=True)
    fits = np.any([np.isfinite(small.best_flights(*station)) for station in each], axis=0)
    wanted, sets = int(inside @ (1 << np.arange(len(inside)))), np.arange(len(fits))
    served, flights = {0}, [int(S) for S in np.flatnonzero(fits) if S & ~wanted == 0]
    for needed in range(len(sets)):
        if wanted in served:
            return needed
        served = {done | flight for done in served for flight in flights}
    raise AssertionError("no plan")


SEEDS = (242, 265, 298, 332, 347, 368, 377, 398, 437, 479, 490)
"""Random farms whose relaxation sends fewer flights into some turbines than these need."""


def test_a_path_enters_a_set_whenever_it_comes_from_outside():
    sets = np.array([[1, 1, 0, 0, 0], [0, 0, 1, 0, 1]], bool)
    crowded = CrowdedSets(sets, np.full(2, 2.0))
    paths = [(0, 1), (0, 2, 1), (3,), (2, 4, 3, 2), (2, 0, 4)]
    assert crowded.entries(paths).tolist() == [[1, 2, 0, 0, 1], [0, 1, 0, 2, 2]]


def test_what_legs_are_granted_is_what_entries_earn():
    rng = np.random.default_rng(0)
    crowded = CrowdedSets(rng.random((5, 8)) < 0.4, np.full(5, 2.0))
    reward = np.append(rng.uniform(0, 10, 4), 0.0)
    grant = crowded.grants(reward)
    for _ in range(20):
        path = tuple(rng.integers(0, 8, int(rng.integers(1, 6))).tolist())
        legs = sum(grant[i, j] for i, j in pairwise((8, *path, 8)))
        assert legs == pytest.approx(reward @ crowded.entries([path])[:, 0])


def test_a_flight_visits_a_set_once():
    crowded = CrowdedSets(np.array([[1, 1, 0], [0, 0, 1]], bool), np.full(2, 2.0))
    members = np.array([[1, 0, 0], [1, 1, 1], [0, 0, 0]], bool)
    assert crowded.visited(members).tolist() == [[1, 1, 0], [0, 1, 0]]


def relaxed(instance, clock):
    search = Search(instance, clock)
    search.offer(alone(search.networks))
    relaxation = Relaxation(search, 1e9, search.counts)
    relaxation.begin()
    return relaxation


@pytest.mark.parametrize("seed", SEEDS)
def test_sets_proved_crowded_need_as_many_flights(seed, small, monkeypatch):
    monkeypatch.setattr(crowding, "LACKING", 1e-3)
    instance = small.random_instance(seed)
    with Clock(60.0) as clock:
        relaxation = relaxed(instance, clock)
        before = relaxation.value
        while relaxation.enter_crowded_sets():
            pass
    assert len(relaxation.master.crowded) > 0
    assert relaxation.value >= before - 1e-3
    proved = relaxation.crowding.proved
    for inside, need in zip(proved.sets, proved.need, strict=True):
        assert fewest_flights(small, instance, inside) >= need


def two_a_flight(n):
    """Return a farm of turbines as far from each other as from the station; two fit a flight."""
    t, places = np.full((1, n + 1, n + 1), 100.0), np.zeros((n, 2))
    allowed = np.ones((1, n), bool)
    return RoutingInstance(t, np.array([310.0]), places[:1], places, np.zeros(2), allowed)


def lacking(n, *paths):
    """Return the sets that need more flights than ``paths``, and how many."""
    with Clock(60.0) as clock:
        known = Crowding.of(networks(two_a_flight(n))[0], np.ones(n, bool), clock)
        found = known.lacking([((0, path), 1.0) for path in paths])
    each = zip(found.sets, found.need, strict=True)
    return {tuple(np.flatnonzero(inside).tolist()): need for inside, need in each}


def test_sets_are_found_into_which_fewer_flights_are_sent_than_they_need():
    assert lacking(6, (0, 1, 2), (3, 4, 5)) == {(0, 1, 2): 2.0, (3, 4, 5): 2.0}
    assert lacking(6, (0, 1), (2, 3), (4, 5)) == {}


def test_a_set_may_need_more_than_two_flights():
    assert lacking(5, (0, 1, 2, 3, 4))[0, 1, 2, 3, 4] == 3.0


def test_turbines_that_may_be_left_out_are_in_no_set(small):
    instance = small.random_instance(SEEDS[0])
    prize = np.full(len(instance.turbines), 1e5)
    with Clock(60.0) as clock:
        relaxation = relaxed(replace(instance, prize=prize), clock)
        assert not relaxation.enter_crowded_sets()
    assert len(relaxation.crowding.proved) == 0


def test_rows_that_overflow_are_taken_back_and_what_was_proved_stays(small, monkeypatch):
    with Clock(60.0) as clock:
        relaxation = relaxed(small.random_instance(SEEDS[0]), clock)
        master, duals, value = relaxation.master, relaxation.duals, relaxation.value
        monkeypatch.setattr(Pricer, "capacity", lambda *_: 1 if len(master.crowded) else 10**5)
        assert not relaxation.enter_crowded_sets()
        assert not relaxation.enter_crowded_sets()
    assert relaxation.duals is duals
    assert relaxation.value == value
    assert relaxation.crowding.rounds == 1
    assert len(master.crowded) == len(relaxation.search.crowded) == 0


@pytest.mark.parametrize("seed", SEEDS)
def test_rows_of_crowded_sets_prove_the_same_optimum(seed, small, monkeypatch):
    """Asked for before anything else they take part in each step that follows."""
    begin, rows = Relaxation.begin, []

    def entered(self):
        begin(self)
        while self.enter_crowded_sets():
            pass
        rows.append(len(self.master.crowded))

    monkeypatch.setattr(Relaxation, "begin", entered)
    monkeypatch.setattr(crowding, "LACKING", 1e-3)
    monkeypatch.setattr("windopt.solving.exact.local_search.ITERATIONS", 0)
    instance = small.random_instance(seed)
    result = column_generation(instance, time_limit=60.0)
    assert result.objective == pytest.approx(small.optimum(instance), rel=1e-9)
    assert result.status is Status.OPTIMAL
    assert rows[0] > 0
