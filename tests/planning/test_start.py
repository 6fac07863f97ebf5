"""Starting from an earlier plan, fresh or stale."""

from dataclasses import replace

import pytest

import windopt
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.inspection import plan_inspection
from windopt.planning.routing_methods import IMPROVES, METHODS

WIND = Wind.from_met(8.0, 90.0)
FARM = Farm("grid", tuple(Turbine(f"T{i}", 900.0 * (i % 4), 800.0 * (i // 4)) for i in range(12)))
FLEET = Fleet(
    (Station("A", 500.0, 900.0, Uav(t_max=700.0)), Station("B", 2500.0, 700.0, Uav(t_max=700.0)))
)


def planned(farm=FARM, fleet=FLEET, wind=WIND, method="exact", **options):
    result = plan_inspection(farm, fleet, wind, method=method, **options)
    assert windopt.check(result).passed
    return result


BEST = planned()


@pytest.mark.parametrize("method", IMPROVES)
def test_a_start_is_never_made_worse(method):
    again = planned(method=method, start=BEST, time_limit=0.0)
    assert again.objective == pytest.approx(BEST.objective)


@pytest.mark.parametrize("direction", [0.0, 180.0, 270.0])
@pytest.mark.parametrize("method", IMPROVES)
def test_a_plan_for_another_wind_is_repaired(method, direction):
    stronger = Wind.from_met(13.0, direction)
    planned(wind=stronger, method=method, start=BEST.found(), time_limit=0.0)


def told(caplog, start, **options):
    """Return what is logged of a start."""
    with caplog.at_level("INFO", logger="windopt.start"):
        planned(start=start, time_limit=0.0, **options)
    return caplog.messages


def test_it_is_told_what_a_start_amounts_to(caplog):
    flights = len(BEST.found().flights)
    duration = f"{BEST.objective:.2f} s in this wind, {flights} of its {flights} flights"
    assert told(caplog, BEST) == [f"Starting from the earlier plan: {duration} as they were."]


def test_it_is_told_how_much_of_a_start_had_to_change(caplog):
    flights = len(BEST.found().flights)
    slower = Fleet(tuple(replace(s, uav=Uav(t_max=400.0)) for s in FLEET.stations))
    (sentence,) = told(caplog, BEST, fleet=slower)
    assert f" 0 of its {flights} flights as they were." in sentence


def test_new_turbines_are_flown_to_and_lost_ones_are_left():
    fewer = replace(FARM, turbines=FARM.turbines[:-2])
    grown = planned(start=planned(farm=fewer), time_limit=0.0)
    assert sum(len(flight.turbines) for flight in grown.found().flights) == 12


def test_a_turbine_visited_twice_is_visited_once():
    plan = BEST.found()
    doubled = replace(plan, flights=plan.flights + plan.flights)
    again = planned(start=doubled, time_limit=0.0)
    assert again.objective == pytest.approx(BEST.objective)


def test_of_too_many_flights_the_best_are_kept():
    few = Fleet(tuple(replace(station, max_flights=1) for station in FLEET.stations))
    stale = planned(fleet=few, start=BEST, time_limit=0.0).found()
    assert len(stale.flights) == 2
    assert len(stale.left_out) < 12


@pytest.mark.parametrize("method", sorted(set(METHODS) - set(IMPROVES)))
def test_heuristics_take_no_start(method):
    with pytest.raises(InvalidInput, match="with a start"):
        planned(method=method, start=BEST)


def test_names_must_match():
    renamed = replace(FARM, turbines=tuple(replace(t, name=t.name + "x") for t in FARM.turbines))
    with pytest.raises(InvalidInput, match="start to visit turbines of the farm"):
        planned(farm=renamed, start=BEST)
    moved = Fleet((replace(FLEET.stations[0], name="C"),))
    with pytest.raises(InvalidInput, match="start to fly from the fleet's stations, C, got 'A'"):
        planned(fleet=moved, start=BEST)


def test_of_many_stations_a_few_are_named():
    many = Fleet(tuple(Station(f"S{i}", 100.0 * i, 0.0) for i in range(1, 10)))
    with pytest.raises(InvalidInput, match=r"stations, S1, S2, S3, S4, S5 and 4 more, got 'A'"):
        planned(fleet=many, start=BEST)


def test_a_plan_without_flights_is_refused():
    nothing = BEST.carrying(None)
    with pytest.raises(InvalidInput, match="start to hold inspection flights"):
        planned(start=nothing)
