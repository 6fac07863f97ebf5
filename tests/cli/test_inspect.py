"""Flights at the command line: records that check passes, and who is inspected."""

import json

import pytest

WIND = "--wind-speed", "10", "--wind-direction", "90"


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


@pytest.mark.parametrize(("own", "most"), [("1", 1), ("3", 2), ("", 2)])
def test_the_smaller_number_of_flights_holds(windopt, folder, own, most):
    (folder / "stations.csv").write_text(f"id,x,y,max_flights\nS1,500,300,{own}\n")
    record = planned(windopt, folder, "--max-flights", "2", "--t-max", "150")
    assert record["stations"][0]["max_flights"] == most


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
    code, out, err = windopt(*other, *words)
    assert code == 0
    assert "Starting from the earlier plan: " in err
    assert "Starting" not in out


def test_a_start_from_other_stations_is_told_the_fleets(windopt, folder):
    planned(windopt, folder, "--out", "first")
    (folder / "stations.csv").write_text("id,x,y\nNorth,500,300\n", encoding="utf-8")
    code, _, err = windopt(*CHOICE, "--start", "first/plan.json")
    assert code == 2
    assert "start to fly from the fleet's stations, North, got 'S1'." in err


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (("--worth", "much"), "--worth to be a number or a file"),
        (("--worth", "stations.csv"), "one column 'turbine'"),
        (("--worth", "1", "--priorities", "stations.csv"), "--worth or --priorities"),
        (("--assignment", "farthest"), "--assignment to be nearest or a file"),
        (("--start", "nothing.json"), "nothing.json to be a readable file"),
        (("--worth", "9", "--method", "baseline"), "method exact where"),
        (("--worth", "few.csv"), "no other, got none for A2, A3, B1, B2."),
        (("--worth", "inf"), "worth >= 0 s and finite, got inf"),
    ],
)
def test_a_choice_that_cannot_be_made_is_named(windopt, folder, options, sentence):
    (folder / "few.csv").write_text("turbine,worth\nA1,1000\n", encoding="utf-8")
    code, _, err = windopt(*CHOICE, *options)
    assert code == 2
    assert sentence in err
