"""FLORIS v4 input files: library turbines, definitions, and the key that is at fault."""

from math import nan

import pytest

from windopt.domain.turbine import SG_8_167
from windopt.errors import InvalidInput
from windopt.io.floris import farm_from_floris, is_floris, library_turbine

OWN = {
    "turbine_type": "own",
    "hub_height": 100.0,
    "rotor_diameter": 150.0,
    "power_thrust_table": {
        "wind_speed": [0.0, 3.9, 4.0, 12.0, 24.0, 24.01],
        "power": [0.0, 0.0, 100.0, 6000.0, 6000.0, 0.0],
    },
}


def document(turbine_type, x=(0.0, 900.0), y=(0.0, 0.0)):
    farm = {"layout_x": list(x), "layout_y": list(y), "turbine_type": turbine_type}
    return {"name": "GCH", "floris_version": "v4", "farm": farm, "flow_field": {}}


def test_one_type_serves_all_turbines():
    farm = farm_from_floris(document(["nrel_5MW"]), "gch.yaml")
    assert (farm.name, farm.source, farm.crs) == ("GCH", "gch.yaml", None)
    assert farm.names == ("T01", "T02")
    assert [turbine.type for turbine in farm.turbines] == [library_turbine("nrel_5MW")] * 2


def test_each_turbine_may_have_its_own():
    farm = farm_from_floris(document(["iea_15MW", OWN]), "")
    library, own = (turbine.type for turbine in farm.turbines)
    assert library.rated_power == 15e6
    assert library.rotor_diameter == pytest.approx(242.24)
    assert (own.name, own.rated_power, own.cut_in, own.cut_out) == ("own", 6e6, 4.0, 24.0)
    assert own.rotor_diameter == pytest.approx(150.0)


def test_an_unknown_turbine_is_assumed_to_be_the_papers_and_noted():
    farm = farm_from_floris(document("mystery"), "")
    assert farm.turbines[0].type == SG_8_167
    assert any("mystery is not in FLORIS's library" in note for note in farm.notes)


@pytest.mark.parametrize("document", [None, [], "farm", {"layouts": []}])
def test_other_documents_are_not_taken_for_floris(document):
    assert not is_floris(document)


@pytest.mark.parametrize(
    ("bad", "complaint"),
    [
        (document(["nrel_5MW"], x=(0.0, nan)), r"farm.layout_x\[1\]"),
        (document(["nrel_5MW"], y=(0.0,)), "farm.layout_y to hold 2 numbers"),
        (document(["nrel_5MW"], (), ()), "an empty farm"),
        (document(["nrel_5MW"] * 3), "farm.turbine_type to hold 1 type or 2"),
        (document([7]), r"farm.turbine_type\[0\] to be a text"),
        (document([{}]), r"turbine_type\[0\].power_thrust_table to be given"),
        (document([OWN | {"rotor_diameter": "x"}]), r"turbine_type\[0\].rotor_diameter"),
        (document([OWN | {"power_thrust_table": {"power": [0], "wind_speed": [1]}}]), "positive"),
        (document([OWN | {"power_thrust_table": {"power": [0], "wind_speed": []}}]), "as long"),
        ({"farm": {}}, "farm.layout_x to be given"),
        ({"farm": 7}, "farm to be a mapping"),
    ],
)
def test_what_cannot_be_used_is_named(bad, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        farm_from_floris(bad, "")
