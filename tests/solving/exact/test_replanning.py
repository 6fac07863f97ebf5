"""Planning neighbouring flights anew: better plans, of all turbines, and an end."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.result import Result, Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import replanning
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.replanning import Replanning
from windopt.solving.exact.search import Search, alone


def solve(instance, start, limit):
    return column_generation(instance, start=start, time_limit=limit)


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


def best_plan(search):
    return column_generation(search.instance).solution


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
    best = column_generation(search.instance).objective
    assert search.objective * search.unit == pytest.approx(best)
    assert sorted(i for _, path in search.flights for i in path) == list(range(20))


def test_it_ends_when_a_plan_from_scratch_is_the_best_again(search):
    replanned = Replanning(search, solve, 0)
    replanned.improve()
    assert replanned.from_scratch
    assert replanned.plan.objective == pytest.approx(search.objective)
    before = replanned.from_scratch
    replanned.improve()
    assert replanned.from_scratch == before


@pytest.fixture
def asked():
    """Return problems and plans that were handed to a method that finds nothing better."""
    return []


@pytest.fixture
def idle(asked):
    def solve(instance, start, limit):
        asked.append((instance, start))
        return Result(Status.FEASIBLE, start, instance.total(start), 0.0, 0.0)

    return solve


def test_problems_are_no_larger_than_allowed_and_none_comes_twice(search, asked, idle):
    replanned = Replanning(search, idle, 0)
    replanned._take(search.flights)
    while (neighbours := replanned._unseen()) is not None:
        replanned._replan(neighbours, 1.0)
    problems = [tuple(map(tuple, instance.turbines)) for instance, _ in asked]
    assert max(map(len, problems)) == 12
    assert len(set(problems)) == len(problems)
    assert search.flights == tuple(alone(search.networks))


def test_flights_too_long_for_a_problem_are_left_alone(search, asked, idle, monkeypatch):
    monkeypatch.setattr(replanning, "SIZES", (2,))
    search.offer([(route.station, route.turbines) for route in best_plan(search)])
    Replanning(search, idle, 0).improve()
    assert all(len(instance.turbines) <= 2 for instance, _ in asked)


def test_a_better_plan_from_elsewhere_is_planned_anew(search, asked, idle):
    replanned = Replanning(search, idle, 0)
    replanned._take(search.flights)
    replanned.known = search.objective
    search.offer([(route.station, route.turbines) for route in best_plan(search)])
    replanned.improve()
    _, start = asked[0]
    assert any(len(route.turbines) > 1 for route in start)


def test_turbines_left_out_may_be_inspected_and_flights_stay_few():
    few = farm(prize=np.full(20, 300.0), max_flights=np.array([2.0]))
    with Clock(60.0) as clock:
        search = Search(few, clock)
        search.offer(())
        Replanning(search, solve, 0).improve()
    best = column_generation(few)
    assert len(best.solution) == len(search.flights) == 2
    assert search.objective * search.unit == pytest.approx(best.objective)


def test_an_interrupt_ends_it_and_loses_nothing(search):
    def interrupted(instance, start, limit):
        return replace(solve(instance, start, limit), status=Status.INTERRUPTED)

    before = search.objective
    with pytest.raises(KeyboardInterrupt):
        Replanning(search, interrupted, 0).improve()
    assert search.objective < before
