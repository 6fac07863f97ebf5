"""A run that is killed leaves nobody behind and ends, resumed, as an undisturbed one."""

import os
import signal
import subprocess
import sys
from time import monotonic, sleep

import pytest

from benchmarks.__main__ import RESULTS, main
from benchmarks.records import ROOT, read_lines

WORDS = ["run", "routing", "--set", "guard", "--method", "algorithm-2"]
PATIENCE = 120.0


def objectives(records):
    return {record["instance"]: record["objective"] for record in records}


def lines_in(path):
    return path.read_text(encoding="utf-8").count("\n") if path.exists() else 0


def wait_until(holds):
    deadline = monotonic() + PATIENCE
    while not holds() and monotonic() < deadline:
        sleep(0.02)
    assert holds()


def test_a_killed_run_goes_on_and_ends_as_an_undisturbed_one(tmp_path):
    lines = tmp_path / "routing.jsonl"
    words = [sys.executable, "-m", "benchmarks", *WORDS, "--jobs", "2", "--out", str(tmp_path)]
    with subprocess.Popen(words, cwd=ROOT, stderr=subprocess.DEVNULL) as run:
        wait_until(lambda: lines_in(lines) >= 2)
        os.kill(run.pid, signal.SIGKILL)
    before = lines.read_text(encoding="utf-8")
    main([*WORDS, "--resume", "--out", str(tmp_path)])
    stored = read_lines(ROOT / RESULTS / "guard" / "routing.jsonl")
    undisturbed = objectives(line for line in stored if line["method"] == "algorithm-2")
    found = read_lines(lines)
    assert objectives(found) == pytest.approx(undisturbed, rel=1e-6)
    assert len(found) == len(undisturbed)
    assert lines.read_text(encoding="utf-8").startswith(before[: before.rfind("\n") + 1])
