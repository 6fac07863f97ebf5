"""Set-points at the command line, for one wind and as a table."""

import json

import pytest

WIND = "--wind-speed", "10", "--wind-direction", "90"


def test_yaw_prints_a_record_that_check_passes(windopt, folder):
    code, out, _ = windopt("yaw", "farm.csv", *WIND, "--nacelle", "200", "--json")
    record = json.loads(out)
    assert code == 0
    assert {"status", "power", "power_baseline", "turbines"} <= set(record)
    assert set(record["turbines"][0]) >= {"name", "yaw", "misalignment", "wind_speed", "power"}
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0


def test_turbines_that_are_replaced_are_not_told_of(windopt, folder):
    command = "yaw", "farm.csv", *WIND, "--method", "algorithm-1"
    assert "SG 8.0-167 DD" in windopt(*command)[2]
    assert "SG 8.0-167 DD" not in windopt(*command, "--turbine", "nrel_5MW")[2]


def test_a_farm_is_steered_under_what_the_options_say(windopt, folder):
    options = ("--turbine", "nrel_5MW", "--turbulence", "0.1", "--bounds", "-20", "15")
    code, out, err = windopt(
        "yaw", "farm.csv", *WIND, *options, "--direction-std", "3", "--farm-cap", "12", "--json"
    )
    assert code == 0, err
    record = json.loads(out)
    steering = record["steering"]
    assert steering["bounds"] == pytest.approx([-20.0, 15.0])
    assert (steering["turbulence"], steering["farm_cap"]) == (0.1, 12e6)
    assert steering["direction_std"] == pytest.approx(3.0)
    assert all(-20.0 <= turbine["yaw"] <= 15.0 for turbine in record["turbines"])
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0


def test_without_wakes_turbines_get_pitch_and_tip_speed_ratio(windopt, folder):
    code, out, _ = windopt("yaw", "farm.csv", *WIND, "--wakes", "none", "--json")
    assert code == 0
    record = json.loads(out)
    assert record["steering"] is None
    assert record["status"] == "optimal"
    assert record["turbines"][0]["tip_speed_ratio"] == pytest.approx(6.91, abs=0.01)
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0


@pytest.mark.parametrize("file", ["table.csv", "table.nc"])
def test_a_yaw_table_is_written_once(windopt, folder, file):
    command = "yaw-table", "farm.csv", "--out", file, "--directions", "80:100:10", "--jobs", "1"
    code, out, _ = windopt(*command, "--speeds", "7,9", "--turbine", "nrel_5MW")
    assert code == 0
    assert "6 winds" in out
    assert (folder / file).stat().st_size > 500
    code, _, err = windopt(*command)
    assert code == 2
    assert "--force" in err
