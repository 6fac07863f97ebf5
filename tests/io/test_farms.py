"""The one door to farms: by name, or by the kind of file."""

import pytest
import yaml

from windopt.domain.farm import Farm
from windopt.errors import InvalidInput
from windopt.io.farms import load_farm

COORDINATES = {"x": [0.0, 500.0], "y": [0.0, 0.0]}
WINDIO = {"name": "windIO", "layouts": {"coordinates": COORDINATES}}
FLORIS = {
    "name": "FLORIS",
    "farm": {"layout_x": [0.0, 500.0], "layout_y": [0.0, 0.0], "turbine_type": ["nrel_5MW"]},
}


@pytest.mark.parametrize("name", ["Walney", "walney", " WALNEY "])
def test_the_built_in_farm_has_a_name(name):
    assert len(load_farm(name)) == 189


def test_the_door_of_the_domain_leads_here():
    assert Farm.load("Walney") == load_farm("Walney")


@pytest.mark.parametrize("document", [WINDIO, FLORIS])
@pytest.mark.parametrize("suffix", [".yaml", ".yml", ".YAML"])
def test_yaml_is_told_apart_by_its_keys(tmp_path, document, suffix):
    path = tmp_path / f"farm{suffix}"
    path.write_text(yaml.safe_dump(document))
    for source in (path, str(path)):
        farm = load_farm(source)
        assert (farm.name, len(farm), farm.source) == (document["name"], 2, str(path))


def test_an_included_turbine_is_read(tmp_path):
    (tmp_path / "turbine.yaml").write_text(
        "{name: T, performance: {rated_power: 3e6}, hub_height: 90, rotor_diameter: 100}"
    )
    path = tmp_path / "farm.yaml"
    path.write_text(yaml.safe_dump(WINDIO) + "turbines: !include turbine.yaml\n")
    assert load_farm(path).turbines[0].type.rated_power == 3e6


def test_a_table_is_a_farm(tmp_path):
    path = tmp_path / "two.csv"
    path.write_text("name,x,y\nA,0,0\nB,1,1\n")
    assert load_farm(str(path)).names == ("A", "B")


@pytest.mark.parametrize(
    ("name", "text", "complaint"),
    [
        ("farm.yaml", "", "neither"),
        ("farm.yaml", "[1, 2]", "windIO's layouts or FLORIS's farm"),
        ("farm.yaml", "{wind_farm: 3}", "wind_farm to be a mapping, got 3"),
        ("farm.txt", "name,x,y", "to end in .yaml, .yml, .csv"),
    ],
)
def test_other_files_are_refused(tmp_path, name, text, complaint):
    path = tmp_path / name
    path.write_text(text)
    for source in (path, str(path)):
        with pytest.raises(InvalidInput, match=complaint):
            load_farm(source)


@pytest.mark.parametrize("name", ["none.yaml", "none.csv"])
def test_a_missing_file_is_no_farms_name(tmp_path, name):
    with pytest.raises(InvalidInput, match="to be a readable file, got No such file"):
        load_farm(str(tmp_path / name))
