"""``windopt forecast`` as a user meets it."""

import json

import numpy as np
import pytest

from windopt.io.built_in import DATA

MONTH = DATA / "wrf-2009-01.csv.gz"


@pytest.fixture
def windopt(windopt, tmp_path, monkeypatch):
    """Run a command and return its exit code, output and complaints."""
    monkeypatch.chdir(tmp_path)
    return windopt


def test_the_shipped_model_is_scored_beside_its_baselines(windopt):
    code, out, _ = windopt("forecast", "evaluate", "shipped", MONTH, "--json")
    table = json.loads(out)
    assert code == 0
    assert table["step_minutes"] == 10
    methods = {method["name"]: method for method in table["methods"]}
    assert {"persistence", "linear autoregression", "conformal persistence", "lstm"} == set(methods)
    assert methods["lstm"]["speed_mae"] < methods["persistence"]["speed_mae"]
    assert len(methods["lstm"]["by_horizon"]) == 4
    assert 0.5 < methods["lstm"]["coverage_90"] <= 1


def test_a_forecast_is_printed_with_its_bands(windopt):
    at = "--time", "2009-01-10T14:00"
    code, out, _ = windopt("forecast", "predict", "shipped", MONTH, *at, "--json")
    forecast = json.loads(out)
    assert code == 0
    assert forecast["issued"].startswith("2009-01-10T14:00")
    for step in forecast["steps"]:
        assert sorted(step["speed_quantiles"]) == step["speed_quantiles"]
    code, out, _ = windopt("forecast", "predict", "shipped", MONTH, *at)
    assert code == 0
    assert "lstm" in out


def test_a_plan_can_use_a_model_of_ones_own(windopt, tmp_path):
    pytest.importorskip("torch")
    train = "forecast", "train", MONTH, "--units", "4", "--epochs", "1", "--out", "own.npz"
    assert windopt(*train)[0] == 0
    assert windopt(*train)[0] == 2
    command = "plan", "Walney", "--wind", MONTH, "--time", "2009-01-10T14:00", "--time-limit", "5"
    code, _, err = windopt(*command, "--forecaster", "own.npz", "--out", "out")
    assert code == 0, err
    assert windopt("check", "out/plan.json")[0] == 0


def series(path, rows, speed="8.0", direction="90"):
    time = np.datetime64("2020-01-01T00:00") + np.arange(rows) * np.timedelta64(10, "m")
    path.write_text("time,speed,direction\n" + "".join(f"{t},{speed},{direction}\n" for t in time))
    return path


@pytest.mark.parametrize("rows", [3, 10])
@pytest.mark.parametrize(
    "command", [("evaluate", "shipped"), ("predict", "shipped"), ("train", "--out", "m.npz")]
)
def test_a_series_too_short_is_refused(windopt, tmp_path, rows, command):
    if command[0] == "train":
        pytest.importorskip("torch")
    code, out, err = windopt("forecast", *command, series(tmp_path / "short.csv", rows))
    assert code == 2
    assert "Expected" in err
    assert "Traceback" not in out + err


def swinging(path, rows, minutes, speed=8.0):
    """Write a wind that swings by 2 m/s and 30 degrees every two hours."""
    time = np.datetime64("2020-01-01T00:00") + np.arange(rows) * np.timedelta64(minutes, "m")
    phase = 2 * np.pi * np.arange(rows) * minutes / 120
    speeds, directions = speed + speed / 4 * np.sin(phase), 350 + 30 * np.sin(phase)
    lines = (f"{t},{s:.3f},{d:.2f}\n" for t, s, d in zip(time, speeds, directions, strict=True))
    path.write_text("time,speed,direction\n" + "".join(lines))
    return path


@pytest.mark.parametrize(("minutes", "step"), [(1, 5), (2, 10), (5, 5)])
def test_rows_that_come_oftener_are_averaged(windopt, tmp_path, minutes, step):
    wind = swinging(tmp_path / "often.csv", 3000, minutes)
    code, out, err = windopt("forecast", "evaluate", "shipped", wind, "--json")
    assert code == 0, err
    table = json.loads(out)
    assert table["step_minutes"] == step
    assert any("Means over" in note for note in table["notes"]) == (minutes != step)


@pytest.mark.parametrize("minutes", [3, 15, 60, 720])
@pytest.mark.parametrize("command", ["evaluate", "predict"])
def test_a_step_without_a_model_is_refused_with_what_to_do(windopt, tmp_path, minutes, command):
    wind = swinging(tmp_path / "seldom.csv", 200, minutes)
    code, _, err = windopt("forecast", command, "shipped", wind)
    assert code == 2
    assert "5 or 10 minutes; train a model" in err


def test_a_model_of_hours_is_trained_on_several_series_and_scored(windopt, tmp_path):
    pytest.importorskip("torch")
    files = [swinging(tmp_path / f"{k}.csv", 600, 30, speed=6.0 + k) for k in range(2)]
    size = "--units", "4", "--epochs", "1", "--history", "360", "--horizon", "60"
    code, out, err = windopt("forecast", "train", *files, *size, "--out", "own.npz")
    assert code == 0, err
    assert out.count("Score it") == 2
    code, out, err = windopt("forecast", "evaluate", "own.npz", files[0])
    assert code == 0, err
    assert "in 90 %" in out


@pytest.mark.parametrize("speed", ["0.0", "0.3"])
def test_a_calm_is_scored_without_complaint(windopt, tmp_path, speed):
    calm = series(tmp_path / "calm.csv", 600, speed=speed)
    assert windopt("forecast", "evaluate", "shipped", calm)[0] == 0
    code, out, _ = windopt("forecast", "predict", "shipped", calm, "--json")
    assert code == 0
    assert json.loads(out)["steps"][0]["wind_speed"] < 1.0


def test_a_stuck_vane_is_told_with_the_forecast(windopt, tmp_path):
    stuck = series(tmp_path / "stuck.csv", 600)
    code, _, err = windopt("forecast", "predict", "shipped", stuck)
    assert code == 0
    assert "look faulty: a direction that rests for hours" in err


def test_a_series_of_nothing_is_refused(windopt, tmp_path):
    empty = series(tmp_path / "empty.csv", 500, speed="nan", direction="nan")
    assert windopt("forecast", "evaluate", "shipped", empty)[0] == 2


def test_a_vane_that_is_stuck_for_months_is_reported(windopt, tmp_path):
    rng = np.random.default_rng(0)
    time = np.datetime64("2020-01-01T00:00") + np.arange(20_000) * np.timedelta64(10, "m")
    speed = 8 + rng.normal(0, 1, len(time))
    direction = np.where(np.arange(len(time)) < 2000, rng.uniform(0, 360, len(time)), 77.0)
    path = tmp_path / "stuck.csv"
    rows = (f"{t},{s:.3f},{d:.2f}\n" for t, s, d in zip(time, speed, direction, strict=True))
    path.write_text("time,speed,direction\n" + "".join(rows))
    code, out, err = windopt("forecast", "evaluate", "shipped", path)
    assert code == 2
    assert "rows masked: a direction that rests for hours" in err
    assert "Traceback" not in out + err


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 cut", b"\x80\x04\x95 pickled"])
def test_a_file_that_is_no_model_is_refused(windopt, tmp_path, content):
    (tmp_path / "bad.npz").write_bytes(content)
    code, out, err = windopt("forecast", "evaluate", "bad.npz", MONTH)
    assert code == 2
    assert "bad.npz" in err
    assert "Traceback" not in out + err
