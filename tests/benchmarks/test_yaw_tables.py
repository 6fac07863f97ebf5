"""Wake steering beside FLORIS: gains in points, times as ratios, failures in plain sight."""

import pytest

from benchmarks.case import Case
from benchmarks.records import appended
from benchmarks.report.pages import write_pages
from benchmarks.report.yaw_tables import (
    beside_floris,
    by_size,
    case_tables,
    every_method,
    not_measured,
    summary,
    tables,
    where_rivals_gain_more,
)
from benchmarks.yaw import INSTANCES, METHODS, measure, show


def line(instance, method, gain, cpu, *, bound=None, status="feasible"):
    return {
        "problem": "yaw",
        "instance": instance,
        "method": method,
        "time_limit": 60.0,
        "seed": 0,
        "status": status,
        "turbines": 25,
        "winds": 1,
        "power": 4e7 * (1 + gain),
        "baseline": 4e7,
        "gain": gain,
        "bound": bound,
        "cpu": cpu,
        "commit": "abc",
        "machine": {"processor": "one", "processors": 1, "memory_gb": 1},
        "versions": {"python": "3"},
        "command": "python -m benchmarks run yaw",
    }


def failed(instance, method):
    names = {"problem": "yaw", "instance": instance, "method": method, "time_limit": 60.0}
    rest = {name: line("", "", 0, 0)[name] for name in ("seed", "commit", "machine", "versions")}
    return names | rest | {"status": "failed", "reason": "out of luck", "command": ""}


AHEAD, BEHIND, TABLE, LOST = (
    "grid5x5-5D-270",
    "grid5x5-5D-272",
    "grid5x5-5D-table",
    "grid5x5-5D-275",
)
LINES = [
    line(AHEAD, "nlp", 0.1030, 0.1, bound=5.5e7),
    line(AHEAD, "floris", 0.1000, 4.0),
    line(BEHIND, "nlp", 0.2000, 0.2, bound=6e7),
    line(BEHIND, "floris", 0.2003, 6.0),
    line(TABLE, "nlp", 0.0400, 5.0, bound=5e7),
    line(TABLE, "floris", 0.0400, 30.0),
    failed(LOST, "nlp"),
    line(LOST, "floris", 0.1, 4.0),
]


def test_gains_differ_by_points_and_times_by_a_ratio(rows):
    ahead, behind, _, _ = rows(beside_floris(LINES, "nlp"))
    assert (ahead["points more"], ahead["times faster"]) == ("+0.300", "40")
    assert (behind["points more"], behind["times faster"]) == ("-0.030", "30")
    assert ahead["bound over power"] == "1.247"  # 55 MW over 44.12 MW


def test_the_least_bound_of_any_method_measures_all(rows):
    refined = line(AHEAD, "serial-refine", 0.1, 0.01, bound=8e7)
    assert rows(beside_floris([*LINES, refined], "serial-refine"))[0]["bound over power"] == "1.250"
    assert rows(beside_floris(LINES, "serial-refine"))[0]["bound over power"] == "-"


def test_a_case_counts_as_no_less_within_two_hundredths_of_a_point(rows):
    (program,) = rows(summary(LINES))
    assert (program["cases"], program["failed"]) == ("3", "1")
    assert program["gain no less than FLORIS's - 0.02 points"] == "2 of 3"
    assert (program["least"], program["most"]) == ("-0.030", "+0.300")
    assert program["points more: mean"] == "+0.090"


def test_tables_of_winds_are_not_timed_among_single_winds(rows):
    single, table = rows(by_size(LINES))
    assert (single["set for"], single["times faster: least"], single["most"]) == (
        "one wind",
        "30",
        "40",
    )
    assert (table["set for"], table["median"]) == ("table", "6")


def test_where_a_rival_gains_more_is_said(rows):
    ahead = line(AHEAD, "slsqp", 0.1031, 0.3)
    behind = {"method": "nonlinear program", "rival": "FLORIS's serial refine"}
    assert rows(where_rivals_gain_more([*LINES, ahead])) == [
        {"instance": BEHIND, **behind, "points less": "0.0300"},
        {
            "instance": AHEAD,
            "method": "nonlinear program",
            "rival": "SLSQP on windopt's wakes",
            "points less": "0.0100",
        },
    ]
    refined = line(AHEAD, "serial-refine", 0.1, 0.01)
    first = rows(where_rivals_gain_more([*LINES, ahead, refined]))[0]
    assert first == {
        "instance": AHEAD,
        "method": "serial refine on compiled wakes",
        "rival": "SLSQP on windopt's wakes",
        "points less": "0.3100",
    }


def test_all_methods_stand_side_by_side_where_rivals_ran(rows):
    (ahead,) = rows(every_method([*LINES, line(AHEAD, "algorithm-1", 0.0, 0.0)]))
    assert ahead == {
        "instance": AHEAD,
        "nonlinear program": "10.300%, 0.1 s",
        "the paper's Algorithm 1": "0.000%, 0 s",
        "FLORIS's serial refine": "10.000%, 4 s",
    }
    assert every_method(LINES) == [["instance"]]


def test_what_failed_and_what_was_not_measured_is_said(rows):
    *_, lost = rows(beside_floris(LINES, "nlp"))
    assert lost["windopt: gain"] == "failed"
    assert rows(beside_floris(LINES, "serial-refine"))[0]["windopt: gain"] == "not measured"
    methods = "floris", "nlp", "serial-refine"
    assert rows(not_measured(LINES, [AHEAD, "row3-5D-272"], methods)) == [
        {"instance": AHEAD, "methods": "serial-refine"},
        {"instance": "row3-5D-272", "methods": "floris, nlp, serial-refine"},
    ]


@pytest.mark.parametrize("lines", [LINES, LINES[:1], LINES[6:7], []])
def test_the_tables_print_whatever_was_measured(lines):
    printed = show(lines)
    assert all(title in printed for title in (*tables(lines), *case_tables(lines)))
    assert ("Over all instances" in printed) == (lines == LINES)
    assert ("out of luck" in printed) == (LINES[6] in lines)


def test_the_page_shows_tables_failures_and_what_is_missing(tmp_path):
    for record in LINES:
        appended(record, tmp_path / "yaw.jsonl")
    page, cases, _ = write_pages(tmp_path, tmp_path / "pages")
    text = page.read_text(encoding="utf-8")
    assert (page.stem, cases.stem) == ("yaw", "yaw-cases")
    for said in "+0.300", "out of luck", "Where a rival's set-points gain more", "not measured":
        assert said in text
    assert "failed" in cases.read_text(encoding="utf-8")


def test_the_full_set_holds_every_other():
    assert {*INSTANCES["small"], *INSTANCES["medium"]} < {*INSTANCES["full"]}


@pytest.mark.parametrize("method", METHODS)
def test_every_method_steers_three_in_a_row_and_is_judged_by_floris(method):
    pytest.importorskip("floris")
    found = measure(Case("yaw", "row3-5D-272", method, 60.0))
    assert found["power"] >= found["baseline"] * (1 - 1e-9)
    assert (found["gain"] > 0.2) is (method != "algorithm-1")  # which knows of no wakes
