"""Planned flights: sound by the independent checker, honest about what is out of reach."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

import windopt
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import SpeedRule
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import FailedCheck, InvalidInput
from windopt.planning import inspection
from windopt.planning.inspection import plan_inspection
from windopt.planning.routing_methods import METHODS
from windopt.result import Status

EAST_WIND = Wind.from_met(10.0, 90.0)


def farm(n=6, seed=0, extent=4000.0):
    xy = np.random.default_rng(seed).uniform(0, extent, (n, 2)).tolist()
    return Farm("random", tuple(Turbine(f"T{i}", x, y) for i, (x, y) in enumerate(xy)))


def fleet(*places, uav=None):
    return Fleet(tuple(Station(f"S{i}", x, y, uav or Uav()) for i, (x, y) in enumerate(places)))


CENTRE = fleet((2000.0, 2000.0))
TWO = fleet((1000.0, 1000.0), (3000.0, 3000.0))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("dwell", [0.0, 45.0])
def test_every_method_plans_what_the_checker_passes(method, dwell):
    result = plan_inspection(farm(), TWO, EAST_WIND, method=method, dwell=dwell)
    assert windopt.check(result).passed
    assert result.bound <= result.objective * (1 + 1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_no_heuristic_beats_the_proven_optimum(seed):
    site = farm(seed=seed)
    optimum = plan_inspection(site, TWO, EAST_WIND, method="time-flow")
    assert optimum.status is Status.OPTIMAL
    for method in METHODS:
        result = plan_inspection(site, TWO, EAST_WIND, method=method)
        assert result.objective >= optimum.objective * (1 - 1e-6)
        assert result.bound <= optimum.objective * (1 + 1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_tours_cut_by_the_papers_rule_are_never_shorter(seed):
    tight = fleet((1000.0, 1000.0), (3000.0, 3000.0), uav=Uav(t_max=700.0))
    published, optimal = (
        plan_inspection(farm(9, seed=seed), tight, EAST_WIND, method=method).objective
        for method in ("algorithm-2-as-published", "algorithm-2")
    )
    assert published >= optimal * (1 - 1e-9)


def test_dwell_is_counted_once_for_each_turbine():
    short = plan_inspection(farm(), CENTRE, EAST_WIND, method="time-flow")
    long = plan_inspection(farm(), CENTRE, EAST_WIND, method="time-flow", dwell=1.0)
    assert long.objective == pytest.approx(short.objective + 6.0)


def test_a_dwell_of_its_own_for_each_turbine():
    result = plan_inspection(farm(3), CENTRE, EAST_WIND, dwell=[10.0, 20.0, 30.0])
    assert result.found().dwell == (10.0, 20.0, 30.0)
    assert windopt.check(result).passed


def test_a_turbine_out_of_reach_is_listed_and_the_rest_is_planned():
    site = farm()
    site = replace(site, turbines=(*site.turbines, Turbine("far", 60_000.0, 0.0)))
    plan = plan_inspection(site, CENTRE, EAST_WIND).found()
    assert [left_out.turbine for left_out in plan.unreachable] == ["far"]
    assert "round trip from S0" in plan.unreachable[0].reason
    assert sum(len(flight.turbines) for flight in plan.flights) == 6


@pytest.mark.parametrize(
    ("wind", "uav", "dwell", "reason"),
    [
        (Wind.from_met(16.0, 0.0), Uav(), 0.0, "above the UAVs' limit"),
        (Wind.from_met(16.0, 0.0), Uav(wind_max=30.0), 0.0, "not below the airspeed"),
        (Wind.from_met(20.0, 0.0), Uav(wind_max=30.0), 0.0, "not below the airspeed"),
        (EAST_WIND, Uav(), 1100.0, "round trip"),
    ],
)
def test_nothing_flies_where_nothing_can(wind, uav, dwell, reason):
    result = plan_inspection(farm(), fleet((0.0, 0.0), uav=uav), wind, dwell=dwell)
    plan = result.found()
    assert plan.flights == ()
    assert len(plan.unreachable) == 6
    assert all(reason in left_out.reason for left_out in plan.unreachable)


def test_a_station_at_a_turbine_serves_it_in_no_time():
    site = Farm("one", (Turbine("A", 5.0, 5.0),))
    result = plan_inspection(site, fleet((5.0, 5.0)), EAST_WIND, method="time-flow", dwell=60.0)
    assert result.objective == pytest.approx(60.0)


@pytest.mark.parametrize("method", METHODS)
def test_a_uav_that_cannot_hold_its_place_visits_not_even_the_turbine_it_is_kept_at(method):
    site = Farm("one", (Turbine("A", 5.0, 5.0),))
    slow = fleet((5.0, 5.0), uav=Uav(airspeed=5.0))
    plan = plan_inspection(site, slow, EAST_WIND, method=method, dwell=60.0).found()
    assert plan.flights == ()
    assert "not below" in plan.unreachable[0].reason


@pytest.mark.parametrize("method", METHODS)
def test_the_papers_rule_is_planned_and_checked_by_itself(method):
    result = plan_inspection(farm(), TWO, EAST_WIND, method=method, rule="paper")
    assert result.found().rule is SpeedRule.PAPER
    assert windopt.check(result).passed


def test_turning_farm_and_wind_together_changes_nothing():
    site, turn = farm(), np.radians(37.0)
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])

    def turned(thing):
        x, y = R @ (thing.x, thing.y)
        return replace(thing, x=float(x), y=float(y))

    there = plan_inspection(
        replace(site, turbines=tuple(turned(turbine) for turbine in site.turbines)),
        Fleet(tuple(turned(station) for station in TWO.stations)),
        Wind(*(R @ EAST_WIND.velocity)),
        method="time-flow",
    )
    here = plan_inspection(site, TWO, EAST_WIND, method="time-flow")
    assert there.objective == pytest.approx(here.objective)


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"method": "magic"}, "method"),
        ({"rule": "none"}, "rule"),
        ({"dwell": -1.0}, "dwell"),
        ({"dwell": nan}, "dwell"),
        ({"dwell": [1.0]}, "dwell"),
        ({"time_limit": nan}, "time_limit"),
        ({"gap": -0.1}, "gap"),
        ({"gap": 1.0}, "gap"),
        ({"gap": nan}, "gap"),
        ({"memory": 1e7}, "memory"),
        ({"memory": nan}, "memory"),
    ],
)
def test_bad_options_are_named(options, field):
    with pytest.raises(InvalidInput, match=f"Expected {field} "):
        plan_inspection(farm(), CENTRE, EAST_WIND, **options)


def test_a_plan_that_fails_its_check_is_withheld(monkeypatch):
    shorter = inspection.Flight

    def fudged(**fields):
        return shorter(**(fields | {"duration": 0.9 * fields["duration"]}))

    monkeypatch.setattr(inspection, "Flight", fudged)
    with pytest.raises(FailedCheck, match="is said to last"):
        plan_inspection(farm(), CENTRE, EAST_WIND)


def test_the_same_seed_gives_the_same_plan():
    once, again = (plan_inspection(farm(12), TWO, EAST_WIND, seed=3) for _ in range(2))
    assert once.found() == again.found()


def test_kriegers_flak_b_is_never_planned_below_its_optimum():
    # Proven by column generation for these k-means stations in 10 m/s from the east.
    places = (
        (377207.336492, 6099712.731540),
        (371536.344716, 6102583.331108),
        (373506.479704, 6096179.013415),
        (367830.249940, 6105759.853716),
    )
    site = Farm.load("Kriegers Flak B")
    for method in "algorithm-2", "baseline":
        result = plan_inspection(site, fleet(*places), EAST_WIND, method=method)
        assert 8349.04 <= result.objective <= 1.15 * 8349.04
        assert result.bound <= 8349.05


def test_an_exact_search_stopped_at_once_knows_no_less_than_a_heuristic():
    site, placed = farm(40, extent=9000.0), fleet((3000.0, 3000.0), (6000.0, 6000.0))
    known = plan_inspection(site, placed, EAST_WIND, method="algorithm-2")
    stopped = plan_inspection(site, placed, EAST_WIND, method="exact", time_limit=0.0)
    assert stopped.status is Status.FEASIBLE
    assert stopped.bound >= known.bound - 1e-6
    assert windopt.check(stopped).passed


@pytest.mark.parametrize("method", ["time-flow", "route-indexed"])
def test_a_gap_that_was_asked_for_is_recorded_and_kept(method):
    result = plan_inspection(farm(9), TWO, EAST_WIND, method=method, gap=0.3)
    assert result.status is Status.OPTIMAL
    assert result.gap <= result.asked_gap == 0.3
    assert windopt.check(result).passed


def test_exact_and_time_flow_prove_the_same_optimum():
    site = farm(12, seed=7)
    exact = plan_inspection(site, TWO, EAST_WIND, method="exact", time_limit=300.0)
    other = plan_inspection(site, TWO, EAST_WIND, method="time-flow", time_limit=300.0)
    assert exact.status is other.status is Status.OPTIMAL
    assert exact.objective == pytest.approx(other.objective, rel=1e-6)
