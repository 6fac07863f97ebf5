"""The checker against plans worked out on paper, and against each way of breaking them."""

from dataclasses import replace
from math import hypot

import pytest

from windopt.checking import check
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import Flight, InspectionPlan, LeftOut, SpeedRule, Unreachable
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.result import Result, Status

# An east wind of 6 m/s and UAVs of 10 m/s: westward legs fly at 10 m/s over ground (16 without
# the cap), eastward ones at 4, northward and southward ones at 8.
WIND = Wind.from_met(6.0, 90.0)
UAV = Uav("test UAV", airspeed=10.0, t_max=1000.0, wind_max=9.0)
FARM = Farm(
    "Paper",
    (
        Turbine("A1", 0.0, 800.0),
        Turbine("A2", -1000.0, 800.0),
        Turbine("B1", -1000.0, 0.0),
        Turbine("C1", 50_000.0, 0.0),
    ),
)
FLEET = Fleet((Station("S1", 0.0, 0.0, UAV), Station("S2", 0.0, 10.0, UAV)))
ROUND = Flight("S1", "test UAV", ("A1", "A2", "B1"), (100.0, 100.0, 100.0, 250.0), 640.0)
FAR = Unreachable("C1", "too far")
PLAN = InspectionPlan(FARM, FLEET, WIND, (30.0, 30.0, 30.0, 30.0), (ROUND,), (FAR,))
RESULT = Result(Status.FEASIBLE, PLAN, 640.0, 600.0, 0.1)


def broken(**changes):
    return replace(PLAN, flights=(replace(ROUND, **changes),))


def test_a_plan_worked_out_on_paper_passes():
    report = check(RESULT)
    assert report.passed, report.violations
    assert report.flights == 1


WORTH = (50.0, 60.0, 70.0, 80.0)
CHOICE = replace(
    PLAN,
    fleet=Fleet((replace(FLEET.stations[0], max_flights=1), FLEET.stations[1])),
    flights=(replace(ROUND, turbines=("A1",), legs=(100.0, 100.0), duration=230.0),),
    worth=WORTH,
    left_out=(LeftOut("A2", "no flight"), LeftOut("B1", "no flight")),
    assignment=(("S1",), ("S1", "S2"), ("S2",), ("S1",)),
)

MUTANTS = {
    "neither visited nor listed": replace(
        PLAN, flights=(replace(ROUND, turbines=("A1", "A2"), legs=(100.0, 100.0, 300.0)),)
    ),
    "visited 2 times": broken(turbines=("A1", "A2", "B1", "A1")),
    "not one of the farm's": broken(turbines=("A1", "A2", "B1", "Z9")),
    "is visited though listed": replace(PLAN, unreachable=(FAR, Unreachable("A1", ""))),
    "but S1 reaches it": replace(PLAN, flights=(), unreachable=(FAR, Unreachable("A1", ""))),
    "listed as unreachable 2 times": replace(PLAN, unreachable=(FAR, FAR)),
    "not one of the fleet's": broken(station="S9"),
    "leg 1 is said to take": broken(station="S2"),
    "is not kept there": broken(uav="another UAV"),
    "no turbine is visited": replace(PLAN, flights=(ROUND, replace(ROUND, turbines=(), legs=()))),
    "3 legs for 3 turbines": broken(legs=(100.0, 100.0, 100.0)),
    "leg 4 is said to take": broken(legs=(100.0, 100.0, 100.0, 200.0)),
    "is flown at 12.50 m/s, above": broken(legs=(100.0, 80.0, 100.0, 250.0)),
    "its legs and dwells 640": broken(duration=600.0),
    "longer than t_max": replace(
        PLAN, fleet=Fleet((Station("S1", 0.0, 0.0, replace(UAV, t_max=639.0)),))
    ),
    "above the UAV's limit": replace(
        PLAN, fleet=Fleet((Station("S1", 0.0, 0.0, replace(UAV, wind_max=5.0)),))
    ),
    "cannot hold its place": replace(
        PLAN, fleet=Fleet((Station("S1", 0.0, 0.0, replace(UAV, airspeed=6.0)),))
    ),
    "cannot be flown": replace(PLAN, wind=Wind.from_met(8.9, 0.0), fleet=Fleet(
        (Station("S1", 0.0, 0.0, replace(UAV, airspeed=8.0)),))),
    "leg 3 is said to take": replace(PLAN, wind=Wind.from_met(6.0, 91.0)),
    "a dwell is negative": replace(PLAN, dwell=(-30.0, 30.0, 30.0, 30.0)),
    "a dwell is negative or not a number": replace(PLAN, dwell=(float("nan"), 30.0, 30.0, 30.0)),
    "3 dwells for 4 turbines": replace(PLAN, dwell=(30.0, 30.0, 30.0)),
    "said to take nan s": broken(legs=(100.0, 100.0, float("nan"), 250.0)),
    "said to take inf s": broken(legs=(100.0, 100.0, float("inf"), 250.0)),
    "said to take -100 s": broken(legs=(-100.0, 100.0, 100.0, 250.0)),
    "said to last nan s": broken(duration=float("nan")),
    "said to last inf s": broken(duration=float("inf")),
    "said to last -640 s": broken(duration=-640.0),
    "the wind of 9.50 m/s is above": replace(PLAN, wind=Wind.from_met(9.5, 90.0)),
    "left out, though none has a worth": replace(CHOICE, worth=None),
    "3 worths for 4 turbines": replace(CHOICE, worth=WORTH[1:]),
    "a worth is negative": replace(CHOICE, worth=(-1.0, *WORTH[1:])),
    "visited though listed as left out": replace(
        CHOICE, left_out=(*CHOICE.left_out, LeftOut("A1", ""))
    ),
    "both as unreachable and as left out": replace(
        CHOICE, left_out=(*CHOICE.left_out, LeftOut("C1", ""))
    ),
    "listed as left out 2 times": replace(CHOICE, left_out=(*CHOICE.left_out, LeftOut("B1", ""))),
    "B1 is neither visited nor listed": replace(CHOICE, left_out=CHOICE.left_out[:1]),
    "S1 flies 1 times, 0 are possible": replace(
        CHOICE, fleet=Fleet((replace(FLEET.stations[0], max_flights=0), FLEET.stations[1]))
    ),
    "inspected from S1, not its own station": replace(CHOICE, assignment=(("S2",),) * 4),
    "station S9, assigned to a turbine": replace(CHOICE, assignment=(("S1", "S9"),) * 4),
    "assigned to 3 of 4 turbines": replace(CHOICE, assignment=(("S1",),) * 3),
}  # fmt: skip


@pytest.mark.parametrize("sentence", MUTANTS)
def test_a_broken_plan_is_rejected(sentence):
    assert any(sentence in violation for violation in check(MUTANTS[sentence]).violations)


def test_turbines_left_out_cost_what_they_are_worth():
    result = Result(Status.FEASIBLE, CHOICE, 230.0 + 60.0 + 70.0, 0.0, 0.1)
    report = check(result)
    assert report.passed, report.violations
    assert not check(replace(result, objective=230.0)).passed


def test_a_turbine_out_of_its_own_stations_reach_is_unreachable():
    plan = replace(
        PLAN, unreachable=(FAR, Unreachable("A1", "")), flights=(), assignment=(("S2",),) * 4
    )
    near = [v for v in check(plan).violations if "A1" in v]
    assert near == ["turbine A1 is listed as unreachable, but S2 reaches it"]


def test_two_flights_of_one_station_pass():
    north = replace(ROUND, turbines=("A1",), legs=(100.0, 100.0), duration=230.0)
    # North-westward, 4.7 m/s of the wind help: capped at 10 m/s over ground.
    far = hypot(1000.0, 800.0) / 10.0
    west = replace(ROUND, turbines=("A2", "B1"), legs=(far, 100.0, 250.0), duration=far + 410.0)
    report = check(replace(PLAN, flights=(north, west)))
    assert report.passed, report.violations


def test_violations_are_listed_in_one_order():
    strange = tuple(Unreachable(f"Z{i}", "") for i in reversed(range(9)))
    known = tuple(Unreachable(name, "") for name in ("B1", "A2", "A1"))
    report = check(replace(PLAN, flights=(), unreachable=(FAR, *strange, *known)))
    named = [sentence.split()[1] for sentence in report.violations]
    assert named == [*(f"Z{i}" for i in range(9)), "A1", "A1", "A2", "A2", "B1", "B1"]


def test_a_longer_dwell_makes_the_flight_too_long():
    report = check(replace(PLAN, dwell=(200.0, 200.0, 200.0, 0.0)))
    assert any("longer than t_max" in violation for violation in report.violations)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"objective": 630.0}, "objective"),
        ({"bound": 650.0}, "does not bound"),
        ({"bound": float("nan")}, "does not bound"),
        ({"status": Status.OPTIMAL, "bound": -float("inf")}, "without a bound"),
        ({"status": Status.OPTIMAL}, "called optimal at a gap of 0.0625, asked was one of 0"),
        ({"status": Status.OPTIMAL, "asked_gap": 0.06}, "asked was one of 0.06"),
        ({"asked_gap": -1.0}, "cannot have been asked for"),
        ({"asked_gap": float("nan")}, "cannot have been asked for"),
        ({"status": Status.INFEASIBLE}, "the status is infeasible"),
    ],
)
def test_a_broken_promise_is_rejected(changes, sentence):
    assert any(sentence in violation for violation in check(replace(RESULT, **changes)).violations)


@pytest.mark.parametrize(
    "changes", [{"asked_gap": 0.07}, {"bound": 640.0}, {"bound": 640.0 * (1 - 9e-7)}]
)
def test_a_proof_to_within_the_gap_asked_for_passes(changes):
    report = check(replace(RESULT, status=Status.OPTIMAL, **changes))
    assert report.passed, report.violations


def test_a_result_without_a_plan_does_not_pass():
    assert not check(replace(RESULT, solution=None)).passed


def test_without_the_cap_the_tail_wind_carries_the_uav():
    fast = replace(UAV, ground_speed_cap=False)
    flight = replace(ROUND, legs=(100.0, 62.5, 100.0, 250.0), duration=602.5)
    fleet = Fleet((Station("S1", 0.0, 0.0, fast),))
    assert check(replace(PLAN, fleet=fleet, flights=(flight,))).passed


def test_the_papers_rule_passes_with_a_warning_where_the_uav_cannot_keep_up():
    # Due north in this wind counts as tail wind: full ground speed, at 11.7 m/s through the air.
    flight = replace(ROUND, legs=(80.0, 100.0, 80.0, 250.0), duration=600.0)
    report = check(replace(PLAN, flights=(flight,), rule=SpeedRule.PAPER))
    assert report.passed, report.violations
    assert any("airspeed of 11.66" in warning for warning in report.warnings)
