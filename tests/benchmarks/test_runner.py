"""Lines come as cases are done, and a run that was ended goes on where it was."""

import json

import pytest

from benchmarks.__main__ import main
from benchmarks.case import Case
from benchmarks.records import read_lines
from benchmarks.runner import key, run

METHODS = "algorithm-2", "baseline"
CASES = [
    Case("routing", f"grid{n}-w10-090-d000", method, 5.0) for n in (3, 5) for method in METHODS
]


def results(records):
    return {key(record): (record["status"], record["objective"]) for record in records}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    lines = tmp_path_factory.mktemp("measured") / "routing.jsonl"
    run(CASES, lines, command="python -m benchmarks run")
    return lines


def test_each_case_has_a_line_with_what_it_depends_on(undisturbed):
    records = read_lines(undisturbed)
    assert {key(record) for record in records} == {case.key for case in CASES}
    for record in records:
        assert {"commit", "versions", "machine", "command", "hash", "cpu"} <= set(record)
        assert record["bound"] <= record["objective"] * (1 + 1e-9)
        assert sorted(i for _, visits in record["flights"] for i in visits) == list(
            range(1, record["turbines"] + 1)
        )


def test_a_run_that_was_killed_ends_as_an_undisturbed_one(undisturbed, tmp_path):
    whole = undisturbed.read_text(encoding="utf-8").splitlines(keepends=True)
    cut = tmp_path / "routing.jsonl"
    cut.write_text("".join(whole[:2]) + whole[2][:40], encoding="utf-8")
    kept = run(CASES, cut)
    assert results(kept) == results(read_lines(undisturbed))
    assert cut.read_text(encoding="utf-8").startswith("".join(whole[:2]))


def test_what_was_done_is_not_run_again(undisturbed, monkeypatch):
    def never(cases, jobs, scheduler):
        assert not list(cases)
        return iter(())

    monkeypatch.setattr("benchmarks.runner.answers", never)
    assert len(run(CASES, undisturbed)) == len(CASES)


def test_a_file_of_lines_is_added_to_only_when_asked(tmp_path):
    (tmp_path / "routing.jsonl").write_text("", encoding="utf-8")
    with pytest.raises(SystemExit, match="--resume"):
        main(["run", "routing", "--out", str(tmp_path)])


def test_lines_hold_no_infinity(undisturbed):
    def refuse(name):
        raise AssertionError(name)

    for line in undisturbed.read_text(encoding="utf-8").splitlines():
        json.loads(line, parse_constant=refuse)
