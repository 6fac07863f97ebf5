"""OptiWindNet's farms by name and handle, and what is said about each."""

import subprocess
import sys

import pytest

from windopt.errors import InvalidInput, MissingExtra
from windopt.io import optiwindnet
from windopt.io.farms import load_farm

pytest.importorskip("optiwindnet")

REPOSITORY = {graph.graph["handle"]: graph.graph for graph in optiwindnet._repository()}


@pytest.mark.parametrize("handle", REPOSITORY)
def test_every_farm_loads_by_handle_and_by_name(handle):
    facts = REPOSITORY[handle]
    farm = load_farm(handle)
    assert load_farm(facts["name"].upper()).names == farm.names
    assert (farm.name, len(farm), len(farm.substations)) == (facts["name"], facts["T"], facts["R"])
    assert (farm.crs is None) == ("utm_zone_number" not in facts)


def test_a_rating_makes_one_type():
    farm = load_farm("Horns Rev 1")
    assert {turbine.type.rated_power for turbine in farm.turbines} == {2e6}
    assert len({id(turbine.type) for turbine in farm.turbines}) == 1
    assert any("rotors are scaled" in note for note in farm.notes)


def test_turbines_may_have_ratings_of_their_own():
    ratings = [turbine.type.rated_power for turbine in load_farm("Walney Extension").turbines]
    assert {rating: ratings.count(rating) for rating in ratings} == {8.25e6: 40, 7e6: 47}


def test_a_name_given_twice_is_told_apart():
    farm = load_farm("Hornsea 2")
    assert {"D36", "D36 (2)"} <= set(farm.names)
    assert "Names given twice, told apart: D36 (2)." in farm.notes


def test_coordinates_that_cannot_be_metres_are_noted():
    assert any("too small" in note for note in load_farm("cazzaro_2022").notes)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("Hornsee 2", "like Hornsea 2, "),
        ("walny", "like Walney, "),
        ("Horns rev", "like Horns Rev 3, Horns Rev 2, Horns Rev 1"),
        ("xqzw", "OptiWindNet (`windopt farms`"),
    ],
)
def test_an_unknown_name_lists_those_that_come_close(name, hint):
    with pytest.raises(InvalidInput) as refused:
        load_farm(name)
    told = str(refused.value)
    assert hint in told
    assert "a file that exists, Walney (built in) or the name of a farm of OptiWindNet" in told
    assert "`windopt farms` lists all" in told
    assert told.endswith(f", got {name!r}.")


def test_every_farm_that_comes_close_is_named_once():
    with pytest.raises(InvalidInput) as refused:
        load_farm("Thanett")
    assert str(refused.value).count("hanet") == 2  # once as it was typed


def test_all_farms_are_listed_in_order():
    names = optiwindnet.optiwindnet_names()
    assert len(names) == len(REPOSITORY)
    assert list(names) == sorted(names)
    assert load_farm(names[-1]).name == names[-1]


def without(monkeypatch, module):
    def repository():
        raise ModuleNotFoundError(f"No module named {module!r}", name=module)

    monkeypatch.setattr(optiwindnet, "_repository", repository)


def test_without_optiwindnet_the_extra_is_named(monkeypatch):
    without(monkeypatch, "optiwindnet")
    with pytest.raises(MissingExtra, match=r"'Thanet' and only Walney is .*windopt\[farms\]"):
        load_farm("Thanet")
    with pytest.raises(MissingExtra, match=r"windopt\[farms\]"):
        optiwindnet.optiwindnet_names()
    assert len(load_farm("walney")) == 189


def test_a_broken_optiwindnet_is_not_taken_for_a_missing_one(monkeypatch):
    without(monkeypatch, "networkx")
    with pytest.raises(ModuleNotFoundError, match="networkx"):
        load_farm("Thanet")


def test_loading_a_farm_does_not_load_the_solver_that_clashes_with_highs():
    code = "import sys, windopt; windopt.Farm.load('Thanet'); print('ortools' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
