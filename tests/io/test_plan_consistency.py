"""Records edited by hand: what they say twice must agree."""

import json
from copy import deepcopy
from functools import reduce

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.plan import Flight, InspectionPlan, Plan, SetPoint, YawPlan
from windopt.domain.turbine import Turbine
from windopt.domain.wind import WindForecast
from windopt.errors import InvalidInput
from windopt.io.plan_consistency import inconsistencies
from windopt.io.plans import json_text, record_of
from windopt.result import Result, Status

FARM = Farm("Two", (Turbine("A1", 0.0, 0.0), Turbine("A2", 700.0, 1 / 3)))
START = np.datetime64("2011-04-13T22:00")
FORECAST = WindForecast(
    START,
    START + np.array([5, 10]).astype("m8[m]"),
    np.array([8.0, 9.1]),
    np.radians([77.7, 350.1]),
    "by hand",
)
WIND = FORECAST.winds[0]
POINTS = tuple(SetPoint(n, 1.1, 0.3, 0.01, 6.91, WIND.speed, 1e6 / 3, 2e6) for n in FARM.names)
TURNED = Result(Status.FEASIBLE, YawPlan(FARM, WIND, POINTS, 1e6, 1.065), 2e6 / 3, 4e6, 0.5)
FLIGHTS = (Flight("S1", "AscTec Falcon 8", ("A1", "A2"), (10.0, 44.0, 46.0), 100.0),)
INSPECTION = InspectionPlan(FARM, Fleet((Station("S1", 9.0, 9.0),)), WIND, (0.0, 0.0), FLIGHTS)
FLOWN = Result(Status.FEASIBLE, INSPECTION, 100.0, 90.0, 1.0)
PLANS = {"yaw": TURNED, "inspection": FLOWN, "plan": Plan(START, FORECAST, (TURNED,) * 2, FLOWN)}
RECORDS = {kind: json.loads(json_text(record_of(plan))) for kind, plan in PLANS.items()}


@pytest.mark.parametrize("kind", RECORDS)
def test_what_windopt_writes_agrees_with_itself(kind):
    assert inconsistencies(RECORDS[kind]) == ()


def edited(kind, path, value):
    record = deepcopy(RECORDS[kind])
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place = reduce(lambda entry, key: entry[key], way, record)
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return record


@pytest.mark.parametrize(
    ("kind", "path", "value", "sentence"),
    [
        ("yaw", "power", 9e6, "power is said to be 9000000.0, 666666.6"),
        ("yaw", "gap", 0.0, "gap is said to be 0.0, 5.0"),
        ("yaw", "wind.speed", 12.0, "wind.speed is said to be 12.0, 8.0"),
        ("yaw", "wind.direction", 90, "wind.direction is said to be 90, 77.7"),
        ("yaw", "turbines.1.rated_power", 9e6, "turbines[1].rated_power is said to be 9000000.0"),
        ("yaw", "turbines.1.rated_power", ..., "turbines[1].rated_power is not said, 8000000.0"),
        ("inspection", "gap", None, "gap is said to be None, 0.1 is found"),
        ("inspection", "gap", True, "gap is said to be True, 0.1 is found"),
        ("inspection", "wind.speed", 10**400, "wind.speed is said to be 1000"),
        ("plan", "yaw.1.time", "2011-04-13T22:11", "yaw[1].time is said to be '2011-04-13T22:11'"),
        ("plan", "yaw.0.power", 0.0, "yaw[0].power is said to be 0.0"),
    ],
)
def test_a_record_edited_in_one_place_is_found_out(kind, path, value, sentence):
    (found,) = inconsistencies(edited(kind, path, value))
    assert found.startswith(sentence)


def test_what_a_user_adds_and_how_types_are_named_does_not_matter():
    record = edited("inspection", "operator", "Jane Doe")
    types = record["farm"]["turbine_types"]
    types["ours"] = types.pop("SG 8.0-167 DD")
    for turbine in record["farm"]["turbines"]:
        turbine["type"] = "ours"
    assert inconsistencies(record) == ()


def test_whole_numbers_may_stand_for_floats():
    record = edited("inspection", "objective", 100)
    record["flights"][0]["legs"] = [10, 44, 46]
    assert inconsistencies(record) == ()


def test_a_plan_with_a_step_too_few_is_left_to_the_checker():
    record = edited("plan", "yaw.1", ...)
    assert inconsistencies(record) == ()


PLACES = ["gap", "asked_gap", "power", "wind", "wind.speed", "turbines", "turbines.0.rated_power"]
WRONG = st.none() | st.booleans() | st.integers() | st.floats() | st.just([]) | st.just({})


@given(path=st.sampled_from(PLACES), value=WRONG)
def test_no_wrong_value_makes_it_stumble(path, value):
    try:
        found = inconsistencies(edited("yaw", path, value))
    except InvalidInput:
        return
    assert all(isinstance(sentence, str) for sentence in found)
