"""``windopt stations``: what it prints, writes and exits with."""

import json
from math import inf

import pytest

from windopt.io.stations import read_stations
from windopt.result import Result, Status

FARM = "name,x,y\nA1,0,0\nA2,600,0\nA3,1200,0\nB1,0,700\nB2,600,700\nC1,12000,0\n"
WIND = "--wind-speed", "10", "--wind-direction", "90"


@pytest.fixture
def windopt(windopt, tmp_path, monkeypatch):
    """Run a command beside farm.csv and return its exit code, output and complaints."""
    (tmp_path / "farm.csv").write_text(FARM, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return windopt


def test_stations_are_counted_proven_and_compared_with_k_means(windopt):
    code, out, _ = windopt("stations", "farm.csv")
    assert code == 0
    assert "cover: 2 stations" in out
    assert "k-means: 2 stations" in out
    assert "Objective 2, bound 2" in out


def test_the_file_is_what_inspect_reads(windopt):
    assert windopt("stations", "farm.csv", "--out", "s.csv")[0] == 0
    assert len(read_stations("s.csv")) == 2
    code, out, _ = windopt("inspect", "farm.csv", *WIND, "--stations", "s.csv", "--json")
    assert code == 0
    assert json.loads(out)["unreachable"] == []
    code, _, err = windopt("stations", "farm.csv", "--out", "s.csv")
    assert code == 2
    assert "--force" in err


def test_the_record_says_what_is_proven(windopt):
    code, out, _ = windopt("stations", "farm.csv", "--stations", "3", "--json")
    record = json.loads(out)
    assert code == 0
    assert (record["status"], record["reason"]) == ("optimal", "")
    assert record["objective"] == pytest.approx(record["placement"]["time"])
    assert record["objective"] <= record["beside"][0]["time"]
    assert len(record["stations"]) == 3


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("--stations", "1"), "takes 2 or more"),
        (("--dwell", "1060"), "turbine A1"),
        (("--method", "k-means", "--dwell", "1060"), "turbine A1"),
    ],
)
def test_where_no_stations_reach_every_turbine_the_reason_is_given(windopt, options, reason):
    code, out, _ = windopt("stations", "farm.csv", *options)
    assert code == 1
    assert reason in out
    code, out, _ = windopt("stations", "farm.csv", *options, "--json")
    assert code == 1
    assert reason in json.loads(out)["reason"]
    assert json.loads(out)["stations"] == []


def test_k_means_says_how_many_turbines_it_leaves_out(windopt):
    code, out, _ = windopt("stations", "farm.csv", "--method", "k-means", "--stations", "1")
    assert code == 0
    assert "1 turbine beyond reach" in out


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (("--method", "magic"), "--method"),
        (("--candidates", "moon"), "--candidates"),
        (("--candidates", "substations"), "candidates"),
        (("--margin", "1"), "margin"),
        (("--dwell=-1",), "dwell"),
        (("--stations", "7"), "stations"),
        (("--t-max", "0"), "t_max"),
    ],
)
def test_what_cannot_be_used_is_named(windopt, options, named):
    code, _, err = windopt("stations", "farm.csv", *options)
    assert code == 2
    assert f"Expected {named}" in err


def test_inspect_places_the_fewest_stations_by_itself(windopt):
    code, out, err = windopt("inspect", "farm.csv", *WIND, "--json")
    assert code == 0
    assert "2 stations placed, the fewest" in err
    assert json.loads(out)["unreachable"] == []


def test_inspect_places_fewer_stations_by_k_means_and_says_so(windopt):
    code, out, err = windopt("inspect", "farm.csv", *WIND, "--stations", "1", "--json")
    assert code == 0
    assert "takes 2 or more" in err
    assert len(json.loads(out)["stations"]) == 1
    assert json.loads(out)["unreachable"] == ["C1"]


LIMIT = (
    "Expected --dwell <= 1026 s, as stations are placed so that 5 % of --t-max is left on landing"
)


@pytest.mark.parametrize(
    ("dwell", "sentence"),
    [
        ("1060", f"{LIMIT}, or --stations of your own, got 1060."),
        ("2000", f"{LIMIT}, got 2000."),
    ],
)
def test_inspect_says_why_no_stations_can_be_placed_and_what_to_change(windopt, dwell, sentence):
    code, _, err = windopt("inspect", "farm.csv", *WIND, "--dwell", dwell)
    assert code == 2
    assert err.splitlines()[-1] == sentence


def test_inspect_asks_for_stations_where_time_does_not_suffice_to_place_them(windopt, monkeypatch):
    nothing = Result(Status.NO_SOLUTION, None, inf, 1.0, 60.0)
    monkeypatch.setattr("windopt.cli.fleets.stations_by_cover", lambda *_, **__: nothing)
    code, _, err = windopt("inspect", "farm.csv", *WIND)
    assert code == 2
    assert "--stations to be given, as the search for them ended early, got none." in err


def test_stations_of_your_own_take_a_dwell_without_reserve(windopt, tmp_path):
    (tmp_path / "feet.csv").write_text(FARM.replace("name", "id"), encoding="utf-8")
    longest = "--dwell", "1060", "--stations", "feet.csv", "--method", "algorithm-2"
    code, out, _ = windopt("inspect", "farm.csv", *WIND, *longest)
    assert code == 0
    assert "Unreachable" not in out
