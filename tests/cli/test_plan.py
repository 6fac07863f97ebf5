"""Plans at the command line: a folder of files, and options of air, rotor and pace."""

import json

import numpy as np
import pytest

from windopt.cli.farm_options import PaceOptions
from windopt.domain.steering import Pace


def test_plan_writes_a_folder_that_check_passes(windopt, folder):
    command = "plan", "farm.csv", "--wind", "wind.csv", "--time", "2020-01-01T12:00"
    code, out, _ = windopt(*command, "--stations", "stations.csv", "--out", "out")
    assert code == 0, out
    record = json.loads((folder / "out" / "plan.json").read_text(encoding="utf-8"))
    assert len(record["yaw"]) == 8
    assert {path.suffix for path in (folder / "out").iterdir()} == {".json", ".png"}
    assert windopt("check", "out/plan.json")[0] == 0


def test_air_and_rotor_of_a_plan_may_be_chosen(windopt, folder):
    command = "plan", "farm.csv", "--wind", "wind.csv", "--stations", "1", "--json"
    options = "--air-density", "1.2", "--power-coefficient", "heier"
    code, out, _ = windopt(*command, *options)
    assert code == 0
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0
    usual = json.loads(windopt(*command)[1])
    assert json.loads(out)["yaw"][0]["power"] != usual["yaw"][0]["power"]


def test_nacelles_turn_at_the_pace_asked_for(windopt, folder):
    options = "--stations", "1", "--yaw-rate", "0.001", "--yaw-threshold", "0", "--json"
    code, out, err = windopt("plan", "farm.csv", "--wind", "wind.csv", *options)
    assert code == 0, err
    record = json.loads(out)
    assert record["pace"] == {"rate": pytest.approx(0.001), "threshold": 0.0}
    steps = [[turbine["nacelle"] for turbine in step["turbines"]] for step in record["yaw"]]
    turned = (np.diff(steps, axis=0) + 180) % 360 - 180
    assert np.abs(turned).max() <= 0.001 * 600 * (1 + 1e-6)
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0


def test_the_usual_pace_is_that_of_the_library():
    assert PaceOptions().pace == Pace()
