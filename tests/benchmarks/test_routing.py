"""The routing benchmark: a line for each answer, and a table made of the lines."""

import csv
import sys

import pytest

from benchmarks import routing
from benchmarks.__main__ import main
from benchmarks.records import read_lines


@pytest.fixture
def farm(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "small.csv"
    path.write_text("name,x,y\nA,0,0\nB,900,0\nC,0,900\n", encoding="utf-8")
    return path


def run(monkeypatch, *words):
    monkeypatch.setattr(sys, "argv", ["benchmarks", *map(str, words)])
    main()


def test_every_method_gets_a_line_with_what_it_depends_on(farm, monkeypatch, tmp_path):
    run(monkeypatch, "run", "routing", f"{farm}:1", "--out", "lines.jsonl")
    records = read_lines(tmp_path / "lines.jsonl")
    assert {record["method"] for record in records} == set(routing.METHODS)
    for record in records:
        assert record["bound"] <= record["objective"] * (1 + 1e-9)
        assert {"commit", "versions", "processors", "time_limit"} <= set(record)


def test_a_failure_is_a_line_too(farm, monkeypatch, tmp_path):
    def fail(*args, **options):
        raise RuntimeError("out of luck")

    monkeypatch.setattr(routing, "plan_inspection", fail)
    run(monkeypatch, "run", "routing", f"{farm}:1", "--methods", "baseline", "--out", "lines.jsonl")
    (record,) = read_lines(tmp_path / "lines.jsonl")
    assert (record["status"], record["reason"]) == ("failed", "out of luck")


def test_the_table_is_made_of_the_lines(farm, monkeypatch, tmp_path):
    run(monkeypatch, "run", "routing", f"{farm}:1", "--out", "lines.jsonl")
    run(monkeypatch, "report", "lines.jsonl", "--out", "table.csv")
    with (tmp_path / "table.csv").open(newline="") as file:
        head, row = csv.reader(file)
    assert head[:2] == ["farm, turbines", "K"]
    assert row[head.index("time-flow")].split(", ")[1] == "optimal"
