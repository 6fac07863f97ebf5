"""Lines of JSON, one for each case: what was measured, by what, and where."""

import json
import os
import subprocess
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from math import isfinite
from pathlib import Path
from typing import Any

from benchmarks.case import Record
from windopt.versions import versions

ROOT = Path(__file__).parents[1]
RIVALS = "pyvrp", "ortools", "floris"
"""Packages that windopt itself does not use."""


def origin(command: str) -> Record:
    """Return what a line says of the code behind it: commit, versions and command."""
    git = ["git", "describe", "--always", "--dirty"]
    head = subprocess.run(git, cwd=ROOT, capture_output=True, text=True, check=False)
    found = versions()
    for package in RIVALS:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return {"commit": head.stdout.strip() or "unknown", "versions": found, "command": command}


@cache
def machine() -> Record:
    """Return what a line says of the machine: its processors and memory."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"processor": _processor(), "processors": os.cpu_count(), "memory_gb": memory // 10**9}


def _processor() -> str:
    table = Path("/proc/cpuinfo")
    for line in table.read_text(encoding="utf-8").splitlines() if table.exists() else ():
        name, _, value = line.partition(":")
        if name.strip() == "model name":
            return value.strip()
    return "unknown"


def appended(record: Record, path: Path) -> None:
    """Add a line to a file, on the disk when this returns."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as lines:
        lines.write(json.dumps(_finite(record), ensure_ascii=False) + "\n")
        lines.flush()
        os.fsync(lines.fileno())


def read_lines(path: Path) -> list[Record]:
    """Read the lines of a file, none if there is none; a last one that was cut off is removed."""
    if not path.exists():
        return []
    text = path.read_bytes()
    whole = text.rfind(b"\n") + 1
    if whole < len(text):
        with path.open("r+b") as lines:
            lines.truncate(whole)
    return [json.loads(line) for line in text[:whole].decode().splitlines()]


def _finite(value: Any) -> Any:
    """Return a value as JSON can hold it: what is not a finite number becomes ``null``."""
    if isinstance(value, float):
        return value if isfinite(value) else None
    if isinstance(value, dict):
        return {name: _finite(member) for name, member in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(member) for member in value]
    return value
