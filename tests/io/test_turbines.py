"""Turbine types by name and from files."""

import numpy as np
import pytest

from windopt.domain.turbine import SG_8_167
from windopt.errors import InvalidInput
from windopt.io.floris import LIBRARY
from windopt.io.turbines import load_turbine_type


def test_the_papers_turbine_has_a_name():
    assert load_turbine_type("SG 8.0-167 DD") is SG_8_167


@pytest.mark.parametrize("name", LIBRARY)
def test_the_library_is_that_of_floris(name):
    floris = pytest.importorskip("floris")
    fmodel = floris.FlorisModel("defaults")
    fmodel.set(turbine_type=[name])
    theirs = fmodel.core.farm.turbine_definitions[0]
    table, ours = theirs["power_thrust_table"], load_turbine_type(name)
    assert ours.curve.wind_speeds == tuple(table["wind_speed"])
    assert np.divide(ours.curve.powers, 1e3) == pytest.approx(np.array(table["power"]))
    assert ours.curve.thrust_coefficients == tuple(table["thrust_coefficient"])
    assert ours.curve.yaw_exponent == table["cosine_loss_exponent_yaw"]
    assert ours.curve.air_density == table["ref_air_density"]
    assert ours.rotor_diameter == pytest.approx(theirs["rotor_diameter"])
    assert ours.hub_height == theirs["hub_height"]


def test_a_turbine_of_ones_own_is_read(tmp_path):
    table = "{wind_speed: [3, 12, 25], power: [0, 2000, 2000], thrust_coefficient: [1, 0.8, 0.1]}"
    own = f"turbine_type: own\nrotor_diameter: 90\nhub_height: 70\npower_thrust_table: {table}\n"
    (tmp_path / "floris.yaml").write_text(own)
    type_ = load_turbine_type(tmp_path / "floris.yaml")
    assert (type_.name, type_.rated_power, type_.height) == ("own", 2e6, 70)
    assert type_.curve.thrust(12.0) == pytest.approx(0.8)
    windio = "name: small\nrotor_diameter: 90\nperformance: {rated_power: 2.0e+6}\n"
    (tmp_path / "windio.yaml").write_text(windio)
    assert load_turbine_type(tmp_path / "windio.yaml").height == 75.0


def test_what_is_no_turbine_is_named(tmp_path):
    with pytest.raises(InvalidInput, match=r"turbine to be a YAML file or one of SG 8"):
        load_turbine_type("V164")
    (tmp_path / "other.yaml").write_text("name: other\n")
    with pytest.raises(InvalidInput, match=r"other\.yaml to hold FLORIS's"):
        load_turbine_type(tmp_path / "other.yaml")
