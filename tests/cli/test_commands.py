"""The command line as a user meets it: what it prints, writes and exits with."""

import json
import sys

import numpy as np
import pytest

from windopt.cli import main
from windopt.cli.farm_options import PaceOptions
from windopt.domain.steering import Pace

FARM = "name,x,y\nA1,0,0\nA2,600,0\nA3,1200,0\nB1,0,700\nB2,600,700\n"
STATIONS = "id,x,y\nS1,500,300\n"
WIND = "--wind-speed", "10", "--wind-direction", "90"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "farm.csv").write_text(FARM, encoding="utf-8")
    (tmp_path / "stations.csv").write_text(STATIONS, encoding="utf-8")
    time = np.datetime64("2020-01-01T00:00") + np.arange(0, 1440, 5).astype("m8[m]")
    rows = [f"{t},{8 + np.sin(i / 9):.3f},{(90 + i / 7) % 360:.2f}" for i, t in enumerate(time)]
    text = "time,speed,direction\n" + "\n".join(rows) + "\n"
    (tmp_path / "wind.csv").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def windopt(monkeypatch, capsys):
    """Run a command and return its exit code, output and complaints."""

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["windopt", *map(str, words)])
        with pytest.raises(SystemExit) as stop:
            main()
        told = capsys.readouterr()
        return stop.value.code or 0, told.out, told.err

    return run


@pytest.mark.parametrize("command", ["demo", "plan", "inspect", "yaw", "stations", "check"])
def test_every_command_has_help(windopt, command):
    code, out, _ = windopt(command, "--help")
    assert code == 0
    assert "Usage" in out


def test_it_knows_its_version(windopt):
    code, out, _ = windopt("--version")
    assert (code, out) == (0, "windopt 0.1.0\n")


@pytest.mark.parametrize("method", ["algorithm-2", "baseline", "time-flow", "route-indexed"])
def test_inspect_prints_a_record_that_check_passes(windopt, folder, method):
    code, out, _ = windopt(
        "inspect", "farm.csv", *WIND, "--stations", "stations.csv", "--method", method, "--json"
    )
    record = json.loads(out)
    assert code == 0
    promised = [
        "status",
        "objective",
        "bound",
        "gap",
        "runtime",
        "stations",
        "flights",
        "unreachable",
    ]
    assert set(promised) <= set(record)
    assert set(record["flights"][0]) >= {"uav", "station", "turbines", "duration"}
    visited = sorted(name for flight in record["flights"] for name in flight["turbines"])
    assert visited == ["A1", "A2", "A3", "B1", "B2"]
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0


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


def test_plan_writes_a_folder_that_check_passes(windopt, folder):
    command = "plan", "farm.csv", "--wind", "wind.csv", "--time", "2020-01-01T12:00"
    code, out, _ = windopt(*command, "--stations", "stations.csv", "--out", "out")
    assert code == 0, out
    record = json.loads((folder / "out" / "plan.json").read_text(encoding="utf-8"))
    assert len(record["yaw"]) == 8
    assert {path.suffix for path in (folder / "out").iterdir()} == {".json", ".png"}
    assert windopt("check", "out/plan.json")[0] == 0


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


@pytest.mark.parametrize(
    "options",
    [
        ("--wind-speed", "16", "--wind-direction", "90"),
        ("--wind-speed", "20", "--wind-direction", "90", "--wind-max", "30"),
        (*WIND, "--dwell", "2000"),
    ],
)
def test_where_nothing_can_fly_the_unreachable_are_listed_with_code_1(windopt, folder, options):
    command = "inspect", "farm.csv", "--stations", "stations.csv"
    code, out, _ = windopt(*command, *options)
    assert code == 1
    unreachable = " ".join(row for row in out.splitlines() if row.startswith("Unreachable:"))
    assert all(name in unreachable for name in ("A1", "A2", "A3", "B1", "B2"))
    assert out.splitlines()[-1] == "No flights. No turbine is within reach."
    assert "Proved" not in out
    record = json.loads(windopt(*command, *options, "--json")[1])
    assert record["unreachable"] == ["A1", "A2", "A3", "B1", "B2"]
    assert record["flights"] == []


PLAN = "plan", "farm.csv", "--wind", "wind.csv"
BAD = {
    "wind speed": ("inspect", "farm.csv", "--wind-speed", "nan", "--wind-direction", "90"),
    "wind direction": ("yaw", "farm.csv", "--wind-speed", "8", "--wind-direction", "inf"),
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
    "power_coefficient": ("yaw", "farm.csv", *WIND, "--power-coefficient", "magic"),
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


CHOICE = "inspect", "farm.csv", *WIND, "--stations", "stations.csv", "--method", "exact", "--json"


def planned(windopt, folder, *options):
    """Return the record that a command prints, once ``windopt check`` has passed it."""
    code, out, err = windopt(*CHOICE, *options)
    assert code == 0, err
    (folder / "record.json").write_text(out, encoding="utf-8")
    assert windopt("check", "record.json")[0] == 0
    return json.loads(out)


def test_with_few_flights_turbines_are_left_out(windopt, folder):
    record = planned(windopt, folder, "--max-flights", "1", "--t-max", "150")
    assert len(record["flights"]) == 1
    assert record["stations"][0]["max_flights"] == 1
    assert record["unreachable"] == ["A3"]
    assert len(record["left_out"]) + len(record["flights"][0]["turbines"]) == 4
    code, out, _ = windopt(*CHOICE[:-1], "--max-flights", "1", "--t-max", "150")
    assert code == 0
    assert "Left out: " in out


def test_priorities_choose_who_is_inspected(windopt, folder):
    few = "--max-flights", "1", "--t-max", "150"
    left_out = planned(windopt, folder, *few)["left_out"][0]
    (folder / "priorities.csv").write_text(f"turbine,priority\n{left_out},9\n", encoding="utf-8")
    assert (
        left_out not in planned(windopt, folder, *few, "--priorities", "priorities.csv")["left_out"]
    )


def test_worth_is_a_number_or_a_table(windopt, folder):
    assert planned(windopt, folder, "--worth", "1000")["left_out"] == []
    rows = "turbine,worth\nA1,1000\nA2,1000\nA3,0\nB1,1000\nB2,1000\n"
    (folder / "worth.csv").write_text(rows, encoding="utf-8")
    assert planned(windopt, folder, "--worth", "worth.csv")["left_out"] == ["A3"]


def test_an_assignment_is_nearest_or_a_table(windopt, folder):
    (folder / "stations.csv").write_text("id,x,y\nS1,500,300\nS2,0,0\n", encoding="utf-8")
    nearest = planned(windopt, folder, "--assignment", "nearest")
    assert nearest["assignment"]["A1"] == ["S2"]
    (folder / "own.csv").write_text("turbine,station\nA1,S1\nA2,S1\nA2,S2\n", encoding="utf-8")
    own = planned(windopt, folder, "--assignment", "own.csv")
    assert (own["assignment"]["A1"], own["assignment"]["A2"]) == (["S1"], ["S1", "S2"])


def test_a_plan_is_a_start_in_another_wind(windopt, folder):
    first = planned(windopt, folder, "--out", "first")
    again = planned(windopt, folder, "--start", "first/plan.json", "--time-limit", "0")
    assert again["objective"] == pytest.approx(first["objective"])
    other = "inspect", "farm.csv", "--wind-speed", "12", "--wind-direction", "200", "--json"
    words = "--stations", "stations.csv", "--method", "exact", "--start", "first/plan.json"
    assert windopt(*other, *words)[0] == 0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--worth", "much"), "--worth to be a number or a file"),
        (("--worth", "stations.csv"), "one column 'turbine'"),
        (("--worth", "1", "--priorities", "stations.csv"), "--worth or --priorities"),
        (("--assignment", "farthest"), "--assignment to be nearest or a file"),
        (("--start", "nothing.json"), "nothing.json to be a readable file"),
        (("--worth", "9", "--method", "baseline"), "method exact where"),
    ],
)
def test_a_choice_that_cannot_be_made_is_named(windopt, folder, options, sentence):
    code, _, err = windopt(*CHOICE, *options)
    assert code == 2
    assert sentence in err


def test_an_interrupt_while_libraries_load_ends_quietly(windopt, monkeypatch):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("windopt.cli._run", interrupted)
    assert windopt("--version") == (130, "", "")
