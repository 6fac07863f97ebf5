"""Processors for workers: none is claimed twice."""

import os
import subprocess
import sys

import pytest

from benchmarks.__main__ import main
from benchmarks.processor import EACH

CLAIM = """
import os, sys
from benchmarks.processor import claim_processors
claimed = claim_processors(int(sys.argv[1]))
print(len(claimed), claimed <= os.sched_getaffinity(0), len(os.sched_getaffinity(0)), flush=True)
print(*claimed, flush=True)
sys.stdin.read()
"""


def claiming(most, folder):
    return subprocess.Popen(
        [sys.executable, "-c", CLAIM, str(most)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "TMPDIR": str(folder)},
    )


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="the system binds no processes")
def test_workers_claim_as_many_processors_as_they_may_and_none_twice(tmp_path):
    free = len(os.sched_getaffinity(0))
    first, second = claiming(1, tmp_path), None
    try:
        assert first.stdout.readline().split() == ["1", "True", "1"]
        taken = set(first.stdout.readline().split())
        second = claiming(free, tmp_path)
        number, inside, bound = second.stdout.readline().split()
        assert (int(number), inside, int(bound)) == (free - 1, str(True), free - 1 or free)
        assert not taken & set(second.stdout.readline().split())
    finally:
        for worker in (first, second):
            if worker is not None:
                worker.communicate()


@pytest.mark.parametrize("words", [["--out", "{}"], ["--out={}"]])
def test_a_line_does_not_tell_the_folder_it_was_written_to(tmp_path, monkeypatch, words):
    words = ["run", "routing", "--instance", "nothing*", *(word.format(tmp_path) for word in words)]
    told = []
    monkeypatch.setattr("benchmarks.__main__._cases", lambda *_: ["a case"])
    monkeypatch.setattr(
        "benchmarks.__main__.run", lambda *_, command, **__: told.append(command) or []
    )
    monkeypatch.setenv(EACH, "1")
    monkeypatch.setattr(sys, "argv", ["benchmarks", *words])
    main(words)
    assert told == ["python -m benchmarks run routing --instance 'nothing*'"]
