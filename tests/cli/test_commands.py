"""All commands as a user meets them: what they print, refuse and exit with."""

import json

import pytest

WIND = "--wind-speed", "10", "--wind-direction", "90"


@pytest.mark.parametrize(
    "command", ["demo", "plan", "inspect", "yaw", "stations", "check", "farms"]
)
def test_every_command_has_help(windopt, command):
    code, out, _ = windopt(command, "--help")
    assert code == 0
    assert "Usage" in out


def test_it_knows_its_version(windopt):
    code, out, _ = windopt("--version")
    assert (code, out) == (0, "windopt 0.1.0\n")


def test_nothing_is_overwritten_unless_forced(windopt, folder):
    command = "inspect", "farm.csv", *WIND, "--out", "out"
    assert windopt(*command)[0] == 0
    before = (folder / "out" / "plan.json").read_bytes()
    code, _, err = windopt(*command)
    assert code == 2
    assert "--force" in err
    assert (folder / "out" / "plan.json").read_bytes() == before
    assert windopt(*command, "--force")[0] == 0


@pytest.mark.parametrize("command", ["demo", "plan", "inspect", "yaw"])
def test_a_folder_that_is_taken_is_refused_before_any_work(windopt, folder, monkeypatch, command):
    def work(*_, **__):
        raise AssertionError("planned although the folder is taken")

    for place in "demo.plan", "plan.make_plan", "inspect.plan_inspection", "yaw.plan_yaw":
        monkeypatch.setattr(f"windopt.cli.{place}", work)
    (folder / "plan.json").touch()
    words = {
        "demo": (),
        "plan": ("farm.csv", "--wind", "wind.csv"),
        "inspect": ("farm.csv", *WIND),
        "yaw": ("farm.csv", *WIND),
    }
    code, _, err = windopt(command, *words[command], "--out", ".")
    assert code == 2
    assert "--force" in err


def test_a_broken_plan_fails_its_check_with_code_1(windopt, folder):
    windopt("inspect", "farm.csv", *WIND, "--out", "out")
    path = folder / "out" / "plan.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    record["flights"][0]["duration"] /= 2
    path.write_text(json.dumps(record), encoding="utf-8")
    code, out, err = windopt("check", path)
    assert code == 1
    assert "failed" in out
    assert "said to last" in err
    report = json.loads(windopt("check", path, "--json")[1])
    assert not report["passed"]


@pytest.mark.parametrize(
    ("command", "edit", "sentence"),
    [
        ("yaw", {"power": 1.0}, "power is said to be 1.0"),
        ("yaw", {"power_baseline": 1.0}, "for every nacelle facing the wind"),
        ("inspect", {"gap": 0.0}, "gap is said to be 0.0"),
        ("inspect", {"status": "optimal"}, "called optimal at a gap"),
    ],
)
def test_a_record_edited_by_hand_fails_its_check(windopt, folder, command, edit, sentence):
    method = ("--method", "algorithm-2") if command == "inspect" else ()
    record = json.loads(windopt(command, "farm.csv", *WIND, *method, "--json")[1])
    (folder / "edited.json").write_text(json.dumps({**record, **edit}), encoding="utf-8")
    code, _, err = windopt("check", "edited.json")
    assert code == 1
    assert sentence in err


PLAN = "plan", "farm.csv", "--wind", "wind.csv"
BAD = {
    "wind speed": ("inspect", "farm.csv", "--wind-speed", "nan", "--wind-direction", "90"),
    "--wind-direction": ("yaw", "farm.csv", "--wind-speed", "8", "--wind-direction", "inf"),
    "method": ("inspect", "farm.csv", *WIND, "--method", "magic"),
    "dwell": ("inspect", "farm.csv", *WIND, "--dwell", "-1"),
    "t_max": ("inspect", "farm.csv", *WIND, "--t-max", "0"),
    "airspeed": ("inspect", "farm.csv", *WIND, "--airspeed", "nan"),
    "--stations to be a number": ("inspect", "farm.csv", *WIND, "--stations", "²"),
    "--stations to be a number or": ("inspect", "farm.csv", *WIND, "--stations=--5"),
    "--stations": ("inspect", "farm.csv", *WIND, "--stations", "nowhere.csv"),
    "stations": ("inspect", "farm.csv", *WIND, "--stations", "99"),
    "farm": ("inspect", "Atlantis", *WIND),
    "--time": ("plan", "farm.csv", "--wind", "wind.csv", "--time", "yesterday"),
    "--time on": ("plan", "farm.csv", "--wind", "wind.csv", "--time", "2020-01-01T12:00+02:00"),
    "--time like": ("plan", "farm.csv", "--wind", "wind.csv", "--time", "now"),
    "--time like 2011": ("plan", "farm.csv", "--wind", "wind.csv", "--time", ""),
    "--out": ("yaw", "farm.csv", *WIND, "--out", "farm.csv"),
    "time": ("plan", "farm.csv", "--wind", "wind.csv", "--time", "1999-01-01"),
    "forecaster": ("plan", "farm.csv", "--wind", "wind.csv", "--forecaster", "magic"),
    "nothing.csv": ("plan", "farm.csv", "--wind", "nothing.csv"),
    "nothing.json": ("check", "nothing.json"),
    "--power-coefficient": ("yaw", "farm.csv", *WIND, "--power-coefficient", "magic"),
    "bounds": ("yaw", "farm.csv", *WIND, "--bounds", "20", "-20"),
    "turbulence": ("yaw", "farm.csv", *WIND, "--turbulence", "0"),
    "turbulence to be a share": ("yaw", "farm.csv", *WIND, "--turbulence", "6"),
    "--direction-std >= 0, got -3.0": ("yaw", "farm.csv", *WIND, "--direction-std", "-3"),
    "--farm-cap >= 0, got -5.0": ("yaw", "farm.csv", *WIND, "--farm-cap", "-5"),
    "--yaw-rate > 0, got 0.0": (*PLAN, "--yaw-rate", "0"),
    "--yaw-threshold >= 0, got -1.0": (*PLAN, "--yaw-threshold", "-1"),
    "turbine": ("yaw", "farm.csv", *WIND, "--turbine", "V164"),
    "--out to end": ("yaw-table", "farm.csv", "--out", "table.xlsx"),
    "--speeds": ("yaw-table", "farm.csv", "--out", "table.csv", "--speeds", "a"),
    "--directions": ("yaw-table", "farm.csv", "--out", "table.csv", "--directions", "0:360"),
    "jobs": ("yaw-table", "farm.csv", "--out", "table.csv", "--jobs", "0"),
    "--wakes": ("yaw", "farm.csv", *WIND, "--wakes", "none", "--farm-cap", "5"),
    "air_density": ("yaw", "farm.csv", *WIND, "--air-density", "-1"),
}


@pytest.mark.parametrize("field", BAD)
def test_bad_input_is_named_with_code_2(windopt, folder, field):
    code, out, err = windopt(*BAD[field])
    assert code == 2
    assert field in err
    assert "Traceback" not in out + err


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("empty.csv", "name,x,y\n"),
        ("twice.csv", "name,x,y\nA1,0,0\nA1,5,5\n"),
        ("nan.csv", "name,x,y\nA1,0,nan\n"),
        ("cut.yaml", "name: cut\nwind_farm:\n  layouts: {coordinates: {x: [1, 2"),
        ("other.yaml", "name: other\n"),
        ("binary.csv", "\x00\x01\x02"),
    ],
)
def test_a_farm_that_cannot_be_read_is_named_with_code_2(windopt, folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    code, out, err = windopt("inspect", name, *WIND)
    assert code == 2
    assert err.startswith("Expected ")
    assert "Traceback" not in out + err


def test_the_demo_plans_the_built_in_farm(windopt, folder):
    code, out, _ = windopt("demo", "--out", "demo", "--time-limit", "2")
    assert code == 0
    assert "check demo/plan.json" in out
    written = {path.name for path in (folder / "demo").iterdir()}
    assert written >= {"plan.json", "flights.geojson", "flights.png", "yaw.png", "forecast.png"}
    assert windopt("check", "demo/plan.json")[0] == 0


def test_an_interrupt_while_libraries_load_ends_in_a_sentence(windopt, monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("windopt.cli._run", interrupted)
    assert windopt("--version") == (130, "", "Stopped before there was an answer.\n")
