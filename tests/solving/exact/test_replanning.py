"""Planning neighbouring flights anew: better plans, of all turbines, and an end."""

from dataclasses import replace
from time import sleep

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.solving import column_generation
from windopt.solving.exact import replanning
from windopt.solving.exact.clock import Clock, OutOfTime
from windopt.solving.exact.replanning import Replanning
from windopt.solving.exact.search import Search, alone


def solve(search, start):
    column_generation._plan(search, start, memory=4e9, seed=0)


def farm(**changes):
    """Return a farm of a station in a corner, its turbines not quite on a grid."""
    rng = np.random.default_rng(4)
    grid = 500.0 * np.argwhere(np.ones((4, 5)))
    places = grid + rng.uniform(0, 200, grid.shape)
    nodes = np.vstack([[[-300.0, -300.0]], places])
    t = np.hypot(*(nodes[:, None] - nodes[None]).T)[None] / 15.0
    allowed = np.ones((1, len(places)), bool)
    given = RoutingInstance(t, np.array([600.0]), nodes[:1], places, np.zeros(2), allowed)
    return replace(given, **changes)


def best(instance):
    return column_generation.column_generation(instance)


def best_flights(search):
    return [(route.station, route.turbines) for route in best(search.instance).solution]


@pytest.fixture(autouse=True)
def problems_of_few_turbines_at_any_time(monkeypatch):
    monkeypatch.setattr(replanning, "SIZES", (8, 12))
    monkeypatch.setattr(replanning, "SHARE", np.inf)


@pytest.fixture
def search():
    with Clock(60.0) as clock:
        search = Search(farm(), clock)
        search.offer(alone(search.networks))
        yield search


def test_a_poor_plan_becomes_the_best(search):
    Replanning(search, solve, 0).improve()
    assert search.objective * search.unit == pytest.approx(best(search.instance).objective)
    assert sorted(i for _, path in search.flights for i in path) == list(range(20))


def test_it_ends_when_a_plan_from_scratch_is_the_best_again(search):
    replanned = Replanning(search, solve, 0)
    replanned.improve()
    assert replanned.from_scratch
    assert replanned.trial.objective == pytest.approx(search.objective)
    before = replanned.from_scratch
    replanned.improve()
    assert replanned.from_scratch == before


def test_time_that_has_no_other_occasion_counts_before_it_passes(search, monkeypatch):
    monkeypatch.setattr(replanning, "SHARE", 0.33)
    replanned = Replanning(search, solve, 0, spent=1e3)
    before = search.objective
    replanned.improve()
    assert search.objective == before
    replanned.improve(ahead=1e4)
    assert search.objective < before


@pytest.fixture
def asked():
    """Return searches and flights that were handed to a method that finds nothing better."""
    return []


@pytest.fixture
def idle(asked):
    def solve(search, start):
        asked.append((search, start))
        search.offer(start)

    return solve


def test_parts_are_no_larger_than_allowed_and_none_comes_twice(search, asked, idle):
    replanned = Replanning(search, idle, 0)
    replanned._take(search.flights)
    for part in replanned.parts:
        replanned._replan(part, 1.0)
    parts = [tuple(map(tuple, few.instance.turbines)) for few, _ in asked]
    assert max(map(len, parts)) == 12
    assert len(set(parts)) == len(parts)
    assert search.flights == tuple(alone(search.networks))


def test_no_part_gets_more_time_than_is_left(asked, idle, monkeypatch):
    monkeypatch.setattr(replanning, "LEAST_PATIENCE", 60.0)
    with Clock(0.5) as clock:
        search = Search(farm(), clock)
        search.offer(alone(search.networks))
        with pytest.raises(OutOfTime):
            Replanning(search, lambda few, start: (idle(few, start), sleep(0.1)), 0).improve()
    assert asked
    assert all(few.clock.limit <= 0.5 for few, _ in asked)


def test_a_plan_from_scratch_counts_where_flights_are_too_long_for_a_part(
    search, asked, idle, monkeypatch
):
    monkeypatch.setattr(replanning, "SIZES", (0,))
    before = search.objective
    Replanning(search, idle, 0).improve()
    assert not asked
    assert search.objective < before


def test_a_better_plan_from_elsewhere_is_planned_anew(search, asked, idle):
    replanned = Replanning(search, idle, 0)
    replanned._take(search.flights)
    replanned.known = search.objective
    search.offer(best_flights(search))
    replanned.improve()
    _, start = asked[0]
    assert any(len(path) > 1 for _, path in start)


def test_turbines_left_out_may_be_inspected_and_flights_stay_few():
    few = farm(prize=np.full(20, 300.0), max_flights=np.array([2.0]))
    with Clock(60.0) as clock:
        search = Search(few, clock)
        search.offer(())
        Replanning(search, solve, 0).improve()
    proved = best(few)
    assert len(proved.solution) == len(search.flights) == 2
    assert search.objective * search.unit == pytest.approx(proved.objective)


def test_an_interrupt_passes_and_loses_nothing(search):
    def interrupted(few, start):
        solve(few, start)
        raise KeyboardInterrupt

    before = search.objective
    with pytest.raises(KeyboardInterrupt):
        Replanning(search, interrupted, 0).improve()
    assert search.objective < before
