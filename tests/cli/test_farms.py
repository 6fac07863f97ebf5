"""The list of farms that go by a name."""

import json

import pytest

from windopt.domain.farm import Farm

pytest.importorskip("optiwindnet")


def test_farms_are_listed_with_what_loads_them(windopt):
    code, out, _ = windopt("farms", "horns", "--json")
    assert code == 0
    listed = json.loads(out)
    assert {farm["name"] for farm in listed} >= {"Horns Rev 1", "Horns Rev 2"}
    for each in listed:
        farm = Farm.load(each["handle"])
        assert (farm.name, len(farm)) == (each["name"], each["turbines"])


def test_a_part_of_a_name_or_handle_finds_a_farm(windopt):
    for part in "kriegers flak b", "kfB":
        code, out, _ = windopt("farms", part)
        assert code == 0
        assert "Kriegers Flak B" in out
        assert "48 turbines" in out


def test_no_farm_so_called_is_told(windopt):
    code, out, err = windopt("farms", "no such farm")
    assert (code, out) == (1, "")
    assert "No farm's name or handle holds 'no such farm'." in err
