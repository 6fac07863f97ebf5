"""Plans under what a user asks for: few flights, worths and priorities, fixed assignments."""

from dataclasses import replace

import pytest

import windopt
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.inspection import plan_inspection
from windopt.planning.routing_methods import METHODS
from windopt.planning.worth import worth_of_priorities
from windopt.result import Status

WIND = Wind.from_met(8.0, 90.0)
ROW = Farm("row", tuple(Turbine(f"T{i}", 1000.0 * i, 0.0) for i in range(8)))
UAV = Uav(t_max=700.0)
WEST, EAST = Station("west", 0.0, 500.0, UAV), Station("east", 7000.0, 500.0, UAV)
FLEET = Fleet((WEST, EAST))
FAR = Fleet(tuple(replace(s, uav=Uav(t_max=900.0)) for s in (WEST, EAST)))


def limited(most):
    return Fleet(tuple(replace(station, max_flights=most) for station in FLEET.stations))


def exact(fleet=FLEET, dwell=60.0, **options):
    result = plan_inspection(ROW, fleet, WIND, method="exact", dwell=dwell, **options)
    assert windopt.check(result).passed
    assert result.status is Status.OPTIMAL
    return result


def inspected(result):
    return {name for flight in result.found().flights for name in flight.turbines}


def test_with_a_flight_each_as_many_turbines_as_possible_are_inspected():
    result = exact(limited(1))
    plan = result.found()
    assert len(plan.flights) == 2
    assert {left.turbine for left in plan.left_out} == set(ROW.names) - inspected(result)
    assert all("No flight is left" in left.reason for left in plan.left_out)
    assert len(plan.left_out) > len(exact(limited(2)).found().left_out) == 0


def test_where_everything_fits_the_limit_changes_nothing():
    free, enough = exact(), exact(limited(8))
    assert enough.found().left_out == ()
    assert enough.objective == pytest.approx(free.objective)


def test_priorities_come_first():
    fleet = Fleet((replace(WEST, max_flights=1), replace(EAST, max_flights=0)))
    usual = inspected(exact(fleet))
    wanted = sorted(set(ROW.names) - usual)[0]
    preferred = exact(fleet, worth=worth_of_priorities(ROW, fleet, {wanted: 9}))
    assert wanted in inspected(preferred)


def test_a_turbine_is_inspected_where_it_is_worth_its_time():
    alone = exact(worth=[1e4] + [0.0] * 7)
    assert inspected(alone) == {"T0"}
    assert alone.objective == pytest.approx(alone.found().duration)
    nothing = exact(worth=1.0)
    assert nothing.found().flights == ()
    assert nothing.objective == pytest.approx(8.0)
    assert "less than a worth of 1 s" in nothing.found().left_out[0].reason


@pytest.mark.parametrize("method", sorted(set(METHODS) - {"exact"}))
@pytest.mark.parametrize(("fleet", "options"), [(limited(1), {}), (FLEET, {"worth": 100.0})])
def test_only_exact_leaves_turbines_out(method, fleet, options):
    with pytest.raises(InvalidInput, match="method exact where"):
        plan_inspection(ROW, fleet, WIND, method=method, **options)


def test_a_fixed_assignment_is_kept_and_never_better():
    joint, nearest = exact(FAR), exact(FAR, assignment="nearest")
    assert nearest.objective >= joint.objective - 1e-6
    for flight in nearest.found().flights:
        own = {"west": {"T0", "T1", "T2", "T3"}, "east": {"T4", "T5", "T6", "T7"}}
        assert set(flight.turbines) <= own[flight.station]


@pytest.mark.parametrize("method", METHODS)
def test_every_method_keeps_an_assignment(method):
    swapped = {"T3": "east", "T4": ["west", "east"]}
    result = plan_inspection(ROW, FAR, WIND, method=method, assignment=swapped)
    assert windopt.check(result).passed
    [flight] = [f for f in result.found().flights if "T3" in f.turbines]
    assert flight.station == "east"
    assert result.found().assignment[4] == ("west", "east")


def test_a_turbine_that_its_own_station_does_not_reach_is_unreachable():
    result = exact(assignment={"T7": "west"})
    assert [left.turbine for left in result.found().unreachable] == ["T7"]
    assert "from west" in result.found().unreachable[0].reason


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"worth": -1.0}, "worth"),
        ({"worth": [1.0]}, "worth"),
        ({"assignment": "farthest"}, "assignment"),
        ({"assignment": {"T99": "west"}}, "assignment"),
        ({"assignment": {"T0": "north"}}, "station of T0"),
        ({"assignment": {"T0": []}}, "station of T0"),
        ({"memory": 1.0}, "memory"),
    ],
)
def test_bad_options_are_named(options, field):
    with pytest.raises(InvalidInput, match=f"Expected {field} "):
        plan_inspection(ROW, FLEET, WIND, method="exact", **options)


@pytest.mark.parametrize("priority", [{"T99": 1}, {"T0": 0}, {"T0": 1.5}])
def test_priorities_are_whole_numbers_of_known_turbines(priority):
    with pytest.raises(InvalidInput, match="Expected priority"):
        worth_of_priorities(ROW, FLEET, priority)
