"""Plans as JSON: what is written is valid, the same every time, and read back as it was."""

import json
from copy import deepcopy
from dataclasses import replace
from functools import reduce
from math import inf, nan, pi, radians
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import windopt.io.plans
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import (
    Flight,
    InspectionPlan,
    LeftOut,
    Plan,
    SetPoint,
    SpeedRule,
    Unreachable,
    YawPlan,
)
from windopt.domain.power_curve import PowerCurve
from windopt.domain.steering import Pace, Steering
from windopt.domain.turbine import SG_8_167, Turbine
from windopt.domain.wind import Wind, WindForecast
from windopt.errors import InvalidInput
from windopt.io.plan_reader import plan_from_record
from windopt.io.plans import json_text, read_plan, record_of, write_plan
from windopt.result import Result, Status

SCHEMA = json.loads(Path(windopt.io.plans.__file__).with_name("plan.schema.json").read_text())
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

FARM = Farm(
    "Rødsand",
    (
        Turbine("A1", 1 / 3, 0.0),
        Turbine('B "2"', 1e6, -0.1, SG_8_167.scaled_to(2e6)),
        Turbine("C3", 0.1 + 0.2, 5.0, replace(SG_8_167, cut_in=3.5, hub_height=100.0)),
    ),
    crs="EPSG:32632",
    substations=((1.5, 2.5),),
    source="by hand",
    notes=("One note.", "Another."),
)
FLEET = Fleet(
    (
        Station("S1", 10.0, 20.0),
        Station("S2", 1 / 7, 0.0, Uav("other", 20.0, 900.0, inf, ground_speed_cap=False)),
    )
)
INSPECTION = InspectionPlan(
    FARM,
    FLEET,
    Wind.from_met(10.0, 77.7),
    dwell=(60.0, 0.1, 0.0),
    flights=(Flight("S1", "AscTec Falcon 8", ("C3", "A1"), (0.1, 0.2, 1 / 3), 60.0 + 1 / 3),),
    unreachable=(Unreachable('B "2"', "Too far."),),
    rule=SpeedRule.PAPER,
)
YAW = YawPlan(
    FARM,
    Wind(8.0, -1 / 3),
    tuple(
        SetPoint(name, radians(271.1), radians(-1.1), 0.01, 6.91, 8.1, 1e6 / 3, 2e6)
        for name in FARM.names
    ),
    power_baseline=1e6,
    air_density=1.065,
)
FLOWN = Result(Status.FEASIBLE, INSPECTION, 60 + 1 / 3, 50.0, 1.25, "relaxation", "Limit reached.")
CURVE = PowerCurve((3.0, 1 / 0.07, 25.0), (0.0, 2e6, 2e6), (1.1, 0.5, 1 / 30))
STEERED = replace(
    YAW,
    farm=FARM.with_turbine_type(replace(SG_8_167, curve=CURVE)),
    set_points=tuple(replace(p, pitch=None, tip_speed_ratio=None) for p in YAW.set_points),
    steering=Steering(
        0.1, -0.5, 0.25, 0.0, ((Wind(8.0, 1 / 3), 0.25), (Wind(8.0, -1.0), 0.75)), 5e6, 0.1
    ),
)
TURNED = Result(Status.LOCALLY_OPTIMAL, YAW, YAW.power, inf, 0.5)
TIMES = np.array(["2011-04-13T22:05", "2011-04-13T22:10"], dtype="datetime64[s]")
FORECAST = WindForecast(
    np.datetime64("2011-04-13T22:00:00"), TIMES, np.array([8.0, 9.1]), np.radians([10, 350.1]),
    "persistence", ("A note.",),
)  # fmt: skip
PACE = Pace(rate=radians(0.25), threshold=0.002)
WHOLE = Plan(np.datetime64("2011-04-13T22:00:30"), FORECAST, (TURNED, TURNED), FLOWN, PACE)

RECORDS = {"inspection": record_of(FLOWN), "yaw": record_of(TURNED), "plan": record_of(WHOLE)}


def back(plan):
    return plan_from_record(json.loads(json_text(record_of(plan))))


def near(plan):
    """Return a yaw result whose angles are rounded, as degrees do not carry every radian."""
    points = tuple(
        replace(p, nacelle=round(p.nacelle, 11), misalignment=round(p.misalignment, 11), pitch=0.01)
        for p in plan.solution.set_points
    )
    return plan.carrying(replace(plan.solution, set_points=points))


@pytest.mark.parametrize("kind", RECORDS)
def test_records_keep_their_schema(kind):
    VALIDATOR.validate(RECORDS[kind])
    assert (RECORDS[kind]["schema"], RECORDS[kind]["version"]) == ("windopt/plan", 2)
    assert RECORDS[kind]["kind"] == kind


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_an_inspection_is_read_back_exactly():
    assert back(FLOWN) == FLOWN


def test_what_was_left_out_and_assigned_is_read_back_exactly():
    first, second = FLEET.stations
    plan = replace(
        INSPECTION,
        fleet=Fleet((replace(first, max_flights=1), second)),
        flights=(replace(INSPECTION.flights[0], turbines=("A1",)),),
        worth=(100.0, 1 / 3, 5.0),
        left_out=(LeftOut("C3", "No flight is left."),),
        assignment=(("S1",), ("S1", "S2"), ("S2",)),
    )
    result = FLOWN.carrying(plan)
    record = record_of(result)
    VALIDATOR.validate(record)
    assert (record["left_out"], record["worth"]["C3"]) == (["C3"], 5.0)
    assert back(result) == result


def test_set_points_are_read_back_but_for_the_last_digits_of_angles():
    assert near(back(TURNED)) == near(TURNED)
    pitch = [point.pitch for point in back(TURNED).solution.set_points]
    assert pitch == pytest.approx([0.01] * 3, abs=1e-11)


def test_what_a_farm_is_steered_under_is_read_back():
    steered = TURNED.carrying(STEERED)
    VALIDATOR.validate(record_of(steered))
    found = back(steered).solution
    assert found.farm == STEERED.farm
    said, expected = found.steering, STEERED.steering
    assert (said.lower, said.upper) == pytest.approx((expected.lower, expected.upper), abs=1e-12)
    assert replace(said, lower=-0.5, upper=0.25) == expected
    assert {point.pitch for point in found.set_points} == {None}


def test_yaw_is_the_misalignment_that_floris_takes():
    point = record_of(TURNED)["turbines"][0]
    assert point["yaw"] == point["misalignment"] == pytest.approx(-1.1)
    assert point["nacelle"] == pytest.approx(271.1)


def test_a_whole_plan_is_read_back():
    plan = back(WHOLE)
    assert (plan.time, plan.inspection) == (WHOLE.time, FLOWN)
    assert [near(step) for step in plan.yaw] == [near(TURNED)] * 2
    assert (plan.pace.rate, plan.pace.threshold) == (pytest.approx(PACE.rate), PACE.threshold)
    assert back(replace(WHOLE, pace=None)).pace is None
    forecast = plan.forecast
    assert (forecast.issued, forecast.method, forecast.notes) == (
        FORECAST.issued,
        "persistence",
        ("A note.",),
    )
    np.testing.assert_array_equal(forecast.time, TIMES)
    assert forecast.time.dtype == TIMES.dtype
    np.testing.assert_array_equal(forecast.speed, FORECAST.speed)
    np.testing.assert_allclose(forecast.theta_met, FORECAST.theta_met, atol=1e-12)


def test_without_a_plan_there_is_nothing_to_record():
    nothing = Result(Status.NO_SOLUTION, None, inf, -inf, 1.0, reason="No time was given.")
    for plan in nothing, replace(WHOLE, inspection=nothing), replace(WHOLE, yaw=(TURNED, nothing)):
        with pytest.raises(ValueError, match=r"limit was reached.*No time was given"):
            record_of(plan)


@pytest.mark.parametrize(("result", "bound"), [(FLOWN, -inf), (TURNED, inf)])
def test_a_bound_that_nobody_proved_is_null(result, bound):
    unproved = replace(result, bound=bound)
    record = record_of(unproved)
    VALIDATOR.validate(record)
    assert (record["bound"], record["gap"]) == (None, None)
    assert back(unproved).bound == bound


@pytest.mark.parametrize("gap", [0.05, inf])
def test_the_gap_asked_for_is_read_back(gap):
    asked = replace(FLOWN, asked_gap=gap)
    VALIDATOR.validate(record_of(asked))
    assert back(asked) == asked


@pytest.mark.parametrize("time", ["2011-04-13", "2011-04-13T22", "2011-04-13T22:00:00.125"])
def test_times_keep_their_resolution(time):
    assert back(replace(WHOLE, time=np.datetime64(time))).time == np.datetime64(time)


def test_equal_plans_give_equal_bytes(tmp_path):
    first = write_plan(WHOLE, tmp_path / "first.json").read_bytes()
    second = write_plan(deepcopy(WHOLE), tmp_path / "second.json").read_bytes()
    assert first == second
    assert first.isascii()


@pytest.mark.parametrize("plan", [FLOWN, TURNED, WHOLE])
def test_a_plan_read_back_is_recorded_alike(plan):
    assert json_text(record_of(back(plan))) == json_text(record_of(plan))


def test_a_file_is_read_back_and_not_overwritten(tmp_path):
    path = write_plan(FLOWN, tmp_path / "out" / "plan.json")
    assert read_plan(path) == FLOWN
    with pytest.raises(InvalidInput, match="--force"):
        write_plan(TURNED, path)
    write_plan(TURNED, path, force=True)
    assert near(read_plan(path)) == near(TURNED)


def test_a_plan_with_a_value_that_is_no_number_is_not_written(tmp_path):
    broken = replace(INSPECTION, flights=(replace(INSPECTION.flights[0], duration=nan),))
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_plan(FLOWN.carrying(broken), tmp_path / "plan.json")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("kind", "path", "value", "complaint"),
    [
        ("yaw", "schema", "other", "schema to be 'windopt/plan', got 'other'"),
        ("yaw", "version", 1, "version to be 2, got 1"),
        ("yaw", "kind", "dance", "kind to be inspection, yaw or plan"),
        ("yaw", "turbines.0.nacelle", None, r"turbines\[0\].nacelle to be a number, got None"),
        ("yaw", "turbines.2.power", "1", r"turbines\[2\].power to be a number, got '1'"),
        ("yaw", "objective", ..., "objective to be given"),
        ("inspection", "objective", None, "objective to be a number, got None"),
        ("inspection", "status", "fine", "status to be one of optimal, .* got 'fine'"),
        ("inspection", "rule", "guess", "rule to be one of exact, paper"),
        ("inspection", "wind.u", ..., "wind.u to be given"),
        ("inspection", "dwell", {"A1": 1.0}, r'dwell.B "2" to be given'),
        ("inspection", "dwell.Z9", 1.0, r"dwell.Z9 to name a turbine of the farm"),
        ("inspection", "unreachable_reasons.A1", "", "A1 to name an unreachable turbine"),
        ("yaw", "turbines.0.name", "Z9", r"turbines\[0\].name to name a turbine of the farm"),
        ("inspection", "stations.1.x", True, r"stations\[1\].x to be a number, got True"),
        ("inspection", "stations.1.id", "S1", "S1 more than once"),
        ("inspection", "stations.0.uav.t_max", -1, "t_max > 0"),
        ("inspection", "stations.0.uav.ground_speed_cap", 1, "to be true or false, got 1"),
        ("inspection", "flights.0.turbines", "A1", r"flights\[0\].turbines to be a list"),
        ("inspection", "flights.0.legs.1", 10**400, r"flights\[0\].legs\[1\] .* finite"),
        ("inspection", "unreachable_reasons", {}, 'unreachable_reasons.B "2" to be given'),
        ("inspection", "farm.turbines", [], "an empty farm"),
        ("inspection", "farm.turbines.0.type", "x", r"farm.turbines\[0\].type to be one of"),
        ("inspection", "farm.substations.0", [1], r"farm.substations\[0\] to be a pair"),
        ("plan", "time", "now", "time to be a time such as .* got 'now'"),
        ("plan", "time", "2011-13-01", "time to be a time"),
        ("plan", "forecast.steps", [], "forecast"),
        ("plan", "forecast.steps.0.time", "NaT", r"forecast.steps\[0\].time"),
        ("plan", "pace.rate", 0.0, "rate > 0 rad/s"),
        ("plan", "pace.threshold", ..., "pace.threshold to be given"),
        ("plan", "yaw.1.status", ..., r"yaw\[1\].status to be given"),
    ],
)
def test_what_cannot_be_used_is_named(kind, path, value, complaint):
    record = deepcopy(RECORDS[kind])
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place = reduce(lambda entry, key: entry[key], way, record)
    if value is ...:
        del place[last]
    else:
        place[last] = value
    with pytest.raises(InvalidInput, match=complaint):
        plan_from_record(record)


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "NaN", '{"schema": Infinity}', "[" * 10**5, b"\xff\xfe\x00", "9" * 5000]
)
def test_what_is_no_json_is_refused(tmp_path, text):
    path = tmp_path / "plan.json"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InvalidInput, match=r"plan\.json|the document"):
        read_plan(path)


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    for path in (tmp_path / "none.json", tmp_path):
        with pytest.raises(InvalidInput, match="readable file"):
            read_plan(path)


def places(value, path=()):
    """Yield the path of every value in a document."""
    yield path
    children = value.items() if isinstance(value, dict) else enumerate(value)
    for key, child in children:
        if isinstance(child, dict | list):
            yield from places(child, (*path, key))
        else:
            yield (*path, key)


PLACES = [path for path in places(RECORDS["plan"]) if path]
WRONG = st.none() | st.booleans() | st.integers() | st.text(max_size=3) | st.just([]) | st.just({})


@given(path=st.sampled_from(PLACES), value=WRONG)
def test_no_wrong_value_anywhere_makes_the_reader_stumble(path, value):
    record = deepcopy(RECORDS["plan"])
    reduce(lambda entry, key: entry[key], path[:-1], record)[path[-1]] = value
    try:
        plan = plan_from_record(record)
    except InvalidInput:
        return
    assert isinstance(plan, Plan | Result)


@given(st.floats(-pi, pi), st.floats(0, 2 * pi))
def test_angles_survive_to_a_billionth_of_a_degree(misalignment, nacelle):
    point = replace(YAW.set_points[0], misalignment=misalignment, nacelle=nacelle)
    result = back(TURNED.carrying(replace(YAW, set_points=(point,))))
    found = result.solution.set_points[0]
    assert np.degrees(found.nacelle - nacelle) == pytest.approx(0, abs=1e-9)
    assert np.degrees(found.misalignment - misalignment) == pytest.approx(0, abs=1e-9)
    assert json_text(record_of(back(result))) == json_text(record_of(result))
