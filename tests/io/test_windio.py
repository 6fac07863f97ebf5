"""windIO plants: every layout of the schema, and the key that is at fault."""

from copy import deepcopy
from math import nan, pi

import pytest

from windopt.domain.turbine import SG_8_167
from windopt.errors import InvalidInput
from windopt.io.windio import farm_from_windio, is_windio

TURBINE = {
    "name": "Small",
    "performance": {"rated_power": 2e6, "cutin_wind_speed": 4, "cutout_wind_speed": 22},
    "hub_height": 70,
    "rotor_diameter": 80,
}
PLANT = {
    "name": "Three",
    "layouts": [{"coordinates": {"x": [0.0, 500.0, 1000], "y": [0.0, 0.0, 100.0]}}],
    "turbines": TURBINE,
}


def changed(path, value):
    """Return the plant with ``value`` at ``path``; ``...`` removes the key."""
    plant = deepcopy(PLANT)
    *way, last = path
    place = plant
    for key in way:
        place = place[key]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return plant


def test_a_plant_is_read():
    farm = farm_from_windio(PLANT, "three.yaml")
    assert (farm.name, farm.source, farm.crs) == ("Three", "three.yaml", None)
    assert farm.names == ("T01", "T02", "T03")
    assert farm.xy.tolist() == [[0, 0], [500, 0], [1000, 100]]
    assert len({id(turbine.type) for turbine in farm.turbines}) == 1
    kind = farm.turbines[0].type
    assert (kind.name, kind.rated_power, kind.hub_height) == ("Small", 2e6, 70)
    assert (kind.cut_in, kind.cut_out) == (4, 22)
    assert kind.swept_area == pytest.approx(pi * 40**2)


def test_a_wind_energy_system_holds_a_plant():
    system = {"name": "system", "site": {}, "wind_farm": PLANT}
    assert is_windio(system)
    assert farm_from_windio(system, "").name == "Three"


def test_a_single_layout_may_stand_alone():
    assert len(farm_from_windio(changed(["layouts"], PLANT["layouts"][0]), "")) == 3


def test_the_first_of_several_layouts_is_used_and_noted():
    other = {"coordinates": {"x": [9.0], "y": [9.0]}}
    farm = farm_from_windio(changed(["layouts"], [*PLANT["layouts"], other]), "")
    assert len(farm) == 3
    assert "The first of 2 layouts is used." in farm.notes


def test_turbines_have_identifiers_and_types_of_their_own():
    plant = changed(["turbine_types"], {0: TURBINE, 1: {**TURBINE, "name": "Other"}})
    plant["layouts"][0] |= {"turbine_types": [1, 0, 1], "turbine_identifiers": ["A", "B", 7]}
    farm = farm_from_windio(plant, "")
    assert farm.names == ("A", "B", "7")
    assert [turbine.type.name for turbine in farm.turbines] == ["Other", "Small", "Other"]


def test_substations_are_read():
    station = {"electrical_substation": {"coordinates": {"x": [1.0], "y": [2.0]}, "capacity": 4}}
    farm = farm_from_windio(changed(["electrical_substations"], [station]), "")
    assert farm.substations == ((1.0, 2.0),)


@pytest.mark.parametrize("crs", [32630, "EPSG:32630", "30U", "+proj=utm +zone=30 +datum=WGS84"])
def test_a_coordinate_system_is_kept(crs):
    plant = changed(["layouts", 0, "coordinates", "crs"], crs)
    assert farm_from_windio(plant, "").crs == "EPSG:32630"
    assert farm_from_windio(changed(["crs"], crs), "").crs == "EPSG:32630"


def test_without_turbines_the_papers_are_assumed_and_noted():
    farm = farm_from_windio(changed(["turbines"], ...), "")
    assert farm.turbines[0].type == SG_8_167
    assert any("SG 8.0-167 DD is assumed" in note for note in farm.notes)


@pytest.mark.parametrize(
    ("performance", "rated_power"),
    [
        ({"power_curve": {"power_values": [0, 1e6, 3e6], "power_wind_speeds": [3, 8, 12]}}, 3e6),
        # 1/2 rho A C_p v^3 with A = 1600 pi m2
        ({"Cp_curve": {"Cp_values": [0.4, 0.4], "Cp_wind_speeds": [5, 10]}}, 1.2315e6),
    ],
)
def test_a_curve_tells_the_rated_power(performance, rated_power):
    farm = farm_from_windio(changed(["turbines", "performance"], performance), "")
    assert farm.turbines[0].type.rated_power == pytest.approx(rated_power, rel=1e-4)


CT = {"Ct_values": [0.8, 0.8, 0.1], "Ct_wind_speeds": [4, 10, 25]}
POWERS = {"power_values": [0, 2e6, 2e6], "power_wind_speeds": [3, 12, 24]}


def test_power_and_thrust_become_a_curve_at_the_speeds_of_both():
    performance = {"power_curve": POWERS, "Ct_curve": CT}
    farm = farm_from_windio(changed(["turbines", "performance"], performance), "")
    curve = farm.turbines[0].type.curve
    assert curve.wind_speeds == (3, 4, 10, 12, 24)
    assert curve.power([7.5, 24.5]) == pytest.approx([1e6, 0.0])
    assert curve.thrust([7.0, 17.5]) == pytest.approx([0.8, 0.45])
    assert not any("C_p model" in note for note in farm.notes)


def test_a_power_coefficient_over_the_wind_becomes_a_curve_up_to_rated_power():
    C_p = {"Cp_values": [0.4, 0.4], "Cp_wind_speeds": [4, 25]}
    performance = {"rated_power": 1.5e6, "Cp_curve": C_p, "Ct_curve": CT}
    farm = farm_from_windio(changed(["turbines", "performance"], performance), "")
    curve = farm.turbines[0].type.curve
    assert curve.power(10.0) == pytest.approx(0.5 * 1.225 * pi * 40**2 * 0.4 * 10**3, rel=1e-3)
    assert curve.power(20.0) == pytest.approx(1.5e6)


def test_curves_without_thrust_are_not_used_and_noted():
    farm = farm_from_windio(changed(["turbines", "performance"], {"power_curve": POWERS}), "")
    assert farm.turbines[0].type.curve is None
    assert any("no thrust coefficients" in note for note in farm.notes)


@pytest.mark.parametrize(
    ("path", "value", "complaint"),
    [
        (
            ["turbines", "performance"],
            {"power_curve": POWERS, "Ct_curve": {"Ct_values": [1]}},
            "Ct_curve.Ct_wind_speeds to be given",
        ),
        (
            ["turbines", "performance"],
            {"power_curve": POWERS, "Ct_curve": CT | {"Ct_wind_speeds": [4, 4, 5]}},
            "Ct_wind_speeds to be two or more, increasing",
        ),
        (["name"], ..., "Expected name to be given"),
        (["layouts"], ..., "Expected layouts to be given"),
        (["layouts"], [], "layouts to hold a layout"),
        (["layouts"], 7, "layouts to be a list, got 7"),
        (["layouts", 0, "coordinates"], ..., r"layouts\[0\].coordinates to be given"),
        (["layouts", 0, "coordinates", "x"], "0, 1", r"layouts\[0\].coordinates.x to be a list"),
        (["layouts", 0, "coordinates", "x"], [0, nan, 1], r"coordinates.x\[1\] .* got nan"),
        (["layouts", 0, "coordinates", "x"], [0, None, 1], r"coordinates.x\[1\] to be a number"),
        (["layouts", 0, "coordinates", "x"], [0, 10**400, 1], r"coordinates.x\[1\] .* finite"),
        (["layouts", 0, "coordinates", "y"], [0, 1], r"coordinates.y to hold 3 entries.* got 2"),
        (["layouts", 0, "coordinates"], {"x": [], "y": []}, "an empty farm"),
        (["layouts", 0, "coordinates", "crs"], 4326, "coordinates.crs to be a projected"),
        (["layouts", 0, "turbine_identifiers"], ["A", "B"], "identifiers to hold 3 entries"),
        (["layouts", 0, "turbine_identifiers"], ["A", "B", "A"], "A more than once"),
        (["layouts", 0, "turbine_types"], [0, 0, 1], "turbine_types to be given"),
        (["turbines", "rotor_diameter"], ..., "turbines.rotor_diameter to be given"),
        (["turbines", "rotor_diameter"], "big", "turbines.rotor_diameter .* 'big'"),
        (["turbines", "performance"], {}, "performance to give rated_power"),
        (["turbines", "performance", "rated_power"], -1, "rated_power > 0"),
        (["electrical_substations"], [{}], r"substations\[0\].electrical_substation to be given"),
    ],
)
def test_what_cannot_be_used_is_named(path, value, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        farm_from_windio(changed(path, value), "")


def test_an_unknown_type_is_named_with_those_known():
    plant = changed(["turbine_types"], {0: TURBINE})
    plant["layouts"][0]["turbine_types"] = [0, 3, 0]
    with pytest.raises(InvalidInput, match=r"turbine_types\[1\] to be one of 0, got 3"):
        farm_from_windio(plant, "")
