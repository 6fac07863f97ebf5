"""The README's example runs, and its commands are those that CI knows."""

import re
import subprocess
import sys
from pathlib import Path

import windopt

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, flags=re.DOTALL)


def test_the_example_runs_as_printed(tmp_path):
    (example,) = blocks("python")
    assert len(example.splitlines()) <= 12
    done = subprocess.run(
        [sys.executable, "-c", example], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "passed" in done.stdout


def test_there_are_two_commands_and_both_pin_their_versions():
    commands = blocks("sh")
    assert len(commands) == 2
    assert all("-c constraints.txt" in command for command in commands)
    assert "windopt demo" in commands[0]
    assert "pytest" in commands[1]


def test_the_version_to_cite_is_this_one():
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {windopt.__version__}\n" in citation
