"""What is not what it should be is named, by whichever function meets it first."""

import numpy as np
import pytest

import windopt
from windopt import Farm, Fleet, InvalidInput, Station, Turbine, Wind, WindSeries
from windopt.errors import listed
from windopt.planning.schedule import plan_schedule
from windopt.planning.yaw_table import plan_yaw_table

FARM = Farm("One", (Turbine("A", 0.0, 0.0),))
FLEET = Fleet((Station("S", 100.0, 0.0),))
WIND = Wind.from_met(8.0, 270.0)
TIME = np.datetime64("2020-01-01T00:00") + np.arange(3) * np.timedelta64(10, "m")
SERIES = WindSeries(TIME, np.full(3, 8.0), np.full(3, 1.0))

FUNCTIONS = {
    "plan": (windopt.plan, {"farm": FARM, "fleet": FLEET, "series": SERIES}),
    "plan_inspection": (windopt.plan_inspection, {"farm": FARM, "fleet": FLEET, "wind": WIND}),
    "plan_yaw": (windopt.plan_yaw, {"farm": FARM, "wind": WIND}),
    "plan_turbine_yaw": (windopt.plan_turbine_yaw, {"farm": FARM, "wind": WIND}),
    "plan_yaw_table": (
        lambda farm: plan_yaw_table(farm, [8.0], [1.0], method="algorithm-1"),
        {"farm": FARM},
    ),
    "plan_schedule": (
        lambda farm, forecast: plan_schedule(farm, forecast, nacelle=0.0),
        {"farm": FARM, "forecast": None},
    ),
}


@pytest.mark.parametrize("wrong", [None, "Walney", 7.0])
@pytest.mark.parametrize(
    ("name", "field"), [(name, field) for name, (_, right) in FUNCTIONS.items() for field in right]
)
def test_what_is_of_another_kind_is_named(name, field, wrong):
    function, right = FUNCTIONS[name]
    with pytest.raises(InvalidInput, match=f"Expected {field} to be a .*, got {wrong!r}"):
        function(**right | {field: wrong})


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        ("A", "A"),
        ("AB", "A, B"),
        ("ABCDE", "A, B, C, D, E"),
        ("ABCDEFG", "A, B, C, D, E and 2 more"),
    ],
)
def test_of_many_names_a_few_are_told(names, sentence):
    assert listed(tuple(names)) == sentence
