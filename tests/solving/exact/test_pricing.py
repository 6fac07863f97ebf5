"""Pricing, enumeration and cuts against a look at every flight."""

from dataclasses import replace
from itertools import permutations
from math import inf

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.completions import completion_bounds
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import SLACK
from windopt.solving.exact.ng_neighbourhoods import Neighbourhoods
from windopt.solving.exact.pricing import MOST_LABELS, Pricer
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone
from windopt.solving.exact.subset_row_cuts import Cuts, memory_along, one_after_the_other
from windopt.solving.exact.waiting_labels import Span, empty_labels


def instance(seed, n=7, k=2):
    """Return a small farm with times that differ by direction."""
    rng = np.random.default_rng(seed)
    stations, turbines = rng.uniform(0, 1000, (k, 2)), rng.uniform(0, 1000, (n, 2))
    t = np.empty((k, n + 1, n + 1))
    for d in range(k):
        nodes = np.vstack([stations[d : d + 1], turbines])
        leg = nodes[None] - nodes[:, None]
        t[d] = np.hypot(leg[..., 0], leg[..., 1]) + 0.3 * np.abs(leg[..., 0]) + 0.2 * leg[..., 1]
    t_max = np.full(k, 1.4 * (t[:, 0, 1:] + t[:, 1:, 0]).max())
    allowed = np.ones((k, n), bool)
    return RoutingInstance(t, t_max, stations, turbines, np.zeros(2), allowed)


def flights(networks):
    """Return every flight without cycles: station, path, time."""
    found = []
    for d, network in enumerate(networks):
        n = len(network.out)
        for size in range(1, n + 1):
            for path in permutations(range(n), size):
                time = network.duration(path)
                if time <= network.t_max:
                    found.append((d, path, time))
    return found


def reduced_costs(duals, cuts, flights):
    """Return the reduced costs of flights, with cuts counted as far as they remember."""
    paths = [path for _, path, _ in flights]
    earned = [duals.pi[list(path)].sum() + duals.toll[d] for d, path, _ in flights]
    paid = duals.penalty @ cuts.coefficients(paths) - duals.reward @ duals.crowded.entries(paths)
    return np.array([time for *_, time in flights]) - earned + paid


def reduced_cost_in_full(duals, cuts, flight):
    d, path, time = flight
    pairs = np.isin(cuts.triples, path).sum(axis=1) >= 2
    visited = duals.crowded.sets[:, list(path)].any(axis=1)
    earned = duals.pi[list(path)].sum() + duals.toll[d] + duals.reward[visited].sum()
    return time - earned + duals.penalty[pairs].sum()


def random_duals(rng, relaxation):
    master = relaxation.master
    pi, sigma = rng.uniform(0, 500, master.n), rng.uniform(-100, 50, len(master.counts))
    penalty, reward = (rng.uniform(0, 200, len(each)) for each in (master.cuts, master.crowded))
    return Duals(pi, sigma, penalty, reward, master.crowded)


def random_crowded_sets(rng, n):
    """Return sets that two flights enter in any plan of one flight to each turbine."""
    sets = np.zeros((3, n), bool)
    for each in sets:
        each[rng.choice(n, int(rng.integers(2, 5)), replace=False)] = True
    return CrowdedSets(sets, np.full(3, 2.0))


@pytest.fixture(params=range(6))
def setting(request):
    """Return a search, its relaxation with all turbines remembered, and some cuts."""
    rng = np.random.default_rng(request.param)
    with Clock(600.0) as clock:
        search = Search(instance(request.param), clock)
        search.offer(alone(search.networks))
        relaxation = Relaxation(search, 1e9, np.tile([0.0, inf], (3, 1)))
        everything = frozenset(range(search.n))
        object.__setattr__(
            relaxation.pricer, "neighbourhoods", Neighbourhoods((everything,) * search.n)
        )
        triples = np.array([sorted(rng.choice(search.n, 3, replace=False)) for _ in range(3)])
        triples = np.unique(triples, axis=0)
        legs = (len(triples), search.n, search.n)
        memory = rng.random(legs) < 0.6 if request.param % 2 else np.ones(legs, bool)
        cuts = Cuts(triples, memory)
        none = CrowdedSets.none(search.n)
        crowded = random_crowded_sets(rng, search.n) if request.param > 2 else none
        relaxation.master.rebuild(relaxation.master.columns, cuts, crowded)
        yield search, relaxation, random_duals(rng, relaxation)


def test_as_many_flights_are_sent_as_the_bound_takes(setting):
    search, relaxation, _ = setting
    relaxation.solve()
    before = relaxation.value
    relaxation.round_flights()
    longest = max(network.t_max for network in search.networks)
    assert relaxation.counts[-1, 0] == np.ceil(search.bound / longest - 1e-6)
    assert sum(x for _, x in relaxation.master.flown()) >= relaxation.counts[-1, 0] - 1e-6
    assert relaxation.value >= before - 1e-6


def test_flights_rounded_from_the_relaxation_do_not_meet(setting):
    _, relaxation, _ = setting
    relaxation.solve()
    flights = relaxation.master.rounded()
    visits = [i for _, path in flights for i in path]
    assert flights
    assert len(visits) == len(set(visits))


def test_cuts_that_overflow_are_taken_back(setting, monkeypatch):
    _, relaxation, _ = setting
    relaxation.solve()
    before = relaxation.value

    def overflow(self, prices):
        return 100_000 if len(relaxation.master.cuts) == held else 1

    held = len(relaxation.master.cuts)
    triples = np.array([[0, 1, k] for k in range(2, 7)])
    monkeypatch.setattr(Pricer, "capacity", overflow)
    monkeypatch.setattr(
        "windopt.solving.exact.relaxation.separate",
        lambda cuts, flown: Cuts(triples, np.ones((5, 7, 7), bool)),
    )
    assert not relaxation.cut(MOST_LABELS)
    assert len(relaxation.master.cuts) == held
    assert relaxation.value == pytest.approx(before, abs=1e-3)


@pytest.mark.parametrize("memory", [1e8, 3e8, 4e9])
def test_room_for_labels_is_made_within_the_memory_given(setting, memory):
    _, relaxation, _ = setting
    pricer = replace(relaxation.pricer, memory=memory)
    prices = relaxation.master.cuts.prices(np.zeros(7), np.zeros(len(relaxation.master.cuts)))
    found, waiting = empty_labels(pricer.capacity(prices), prices.inside.shape, Span(1.0, 0.5, 0.1))
    kept = sum(column.nbytes for column in found)
    at_work = kept + sum(column.nbytes for column in waiting)
    sides = 2 * len(pricer.networks)
    assert sides * kept + min(sides, pricer.clock.threads) * at_work <= 1.01 * memory


def test_the_least_reduced_cost_is_found(setting):
    search, relaxation, duals = setting
    priced = relaxation.pricer.price(relaxation.master, duals, exact=True)
    all_flights = flights(search.networks)
    costs = reduced_costs(duals, relaxation.master.cuts, all_flights)
    stations = np.array([d for d, *_ in all_flights])
    for d in range(2):
        least = costs[stations == d].min()
        assert priced.least[d] == pytest.approx(min(0.0, least), abs=1e-5)


def test_bounds_on_completions_lose_no_flight(setting, monkeypatch):
    _, relaxation, duals = setting
    bounded = relaxation.pricer.price(relaxation.master, duals, exact=True)
    monkeypatch.setattr("windopt.solving.exact.pricing.completion_bounds", lambda *_: None)
    free = relaxation.pricer.price(relaxation.master, duals, exact=True)
    assert bounded.least == pytest.approx(free.least)
    assert {frozenset(column.path) for column in bounded.columns} == {
        frozenset(column.path) for column in free.columns
    }


def test_no_flight_ends_for_less_than_its_bounds(setting):
    search, relaxation, duals = setting
    prices = relaxation.master.cuts.prices(duals.pi, duals.penalty)
    loose = relaxation.pricer.loose(prices, duals.grant)
    limits = duals.toll + 100.0
    bounds = completion_bounds(loose, limits)
    for d, path, time in flights(search.networks):
        network, earned = search.networks[d], duals.pi[list(path)].sum()
        total = time - earned - duals.reward @ duals.crowded.entries([path])[:, 0]
        if total > limits[d]:
            continue
        for end in range(1, len(path) + 1):
            flown = network.duration(path[:end]) - network.back[path[end - 1]]
            so_far = flown - duals.pi[list(path[:end])].sum()
            so_far -= duals.reward @ duals.crowded.entries([path[:end]])[:, 0]
            left = int((network.t_max - flown + SLACK) / bounds[2 * d].step)
            assert so_far + bounds[2 * d].table[path[end - 1], left] <= total + 1e-9


def test_flights_found_are_as_cheap_as_they_claim(setting):
    search, relaxation, duals = setting
    priced = relaxation.pricer.price(relaxation.master, duals, exact=False, keep=2)
    assert (reduced_costs(duals, relaxation.master.cuts, priced.columns) < 0).all()
    for d, path, time in priced.columns:
        assert time == pytest.approx(search.networks[d].duration(path))
        assert time <= search.networks[d].t_max + 1e-6


def test_all_flights_within_the_gap_are_listed_and_no_others(setting):
    search, relaxation, _ = setting
    relaxation.solve()
    fixing = relaxation.fix_arcs()
    gap = 0.3 * (search.ceiling - fixing.value)
    networks = fixing.useful(relaxation.pricer.networks, gap)
    pool, _ = enumerate_flights(networks, fixing, gap, 100_000, 1e9, search.clock)
    wanted = {}
    for flight in flights(search.networks):
        if reduced_cost_in_full(relaxation.duals, relaxation.master.cuts, flight) <= gap:
            key = frozenset(flight[1])
            wanted[key] = min(wanted.get(key, inf), flight[2])
    listed = {frozenset(pool.path(r)): pool.cost[r] for r in range(len(pool))}
    assert wanted.keys() <= listed.keys()
    assert len(listed) == len(pool)
    for key, time in wanted.items():
        assert listed[key] == pytest.approx(time)
    for r in range(len(pool)):
        duration = search.networks[pool.station[r]].duration(pool.path(r))
        assert duration == pytest.approx(pool.cost[r])


def test_a_cut_that_remembers_everything_counts_every_second_visit():
    rng = np.random.default_rng(0)
    triples = np.array([[0, 1, 2], [1, 4, 6]])
    cuts = Cuts(triples, np.ones((2, 8, 8), bool))
    paths = [tuple(rng.integers(0, 8, size).tolist()) for size in (1, 3, 5, 9)]
    visits = np.array([[np.isin(path, triple).sum() for path in paths] for triple in triples])
    assert (cuts.coefficients(paths) == visits // 2).all()


def test_a_cut_forgets_a_visit_on_a_leg_outside_its_memory():
    memory = np.zeros((1, 5, 5), bool)
    memory[0, [0, 1, 3], [1, 2, 0]] = True
    cuts = Cuts(np.array([[0, 1, 2]]), memory)
    paths = [(0, 1), (0, 3, 1), (0, 3, 1, 2), (1, 0), (0, 1, 2, 0, 1)]
    assert cuts.coefficients(paths).tolist() == [[1.0, 0.0, 1.0, 0.0, 2.0]]


def test_the_memory_of_a_cut_holds_the_legs_between_two_visits():
    flat = one_after_the_other([(3, 0, 4, 1, 3, 2), (5, 2, 5)])
    first, second = memory_along(np.array([[0, 1, 2], [1, 4, 5]]), *flat, 6)
    assert np.argwhere(first).tolist() == [[0, 4], [4, 1]]
    assert np.argwhere(second).tolist() == [[2, 5], [4, 1], [5, 2]]
