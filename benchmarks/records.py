"""Records of benchmarks: a JSON line for each answer, and tables made of them."""

import csv
import json
import os
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rich.console import Console

from windopt.versions import versions

ROOT = Path(__file__).parents[1]


def machine() -> dict[str, Any]:
    """Return what a figure depends on beside the code: commit, versions and processors."""
    head = subprocess.run(
        ["git", "describe", "--always", "--dirty"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    commit = head.stdout.strip() or "unknown"
    return {"commit": commit, "processors": os.cpu_count(), "versions": versions()}


def write_lines(records: Iterable[dict[str, Any]], path: Path) -> None:
    """Write records as they come, a line each, and show them."""
    console = Console(highlight=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8") as lines:
        for record in records:
            lines.write(json.dumps(record) + "\n")
            lines.flush()
            shown = {name: value for name, value in record.items() if name != "versions"}
            console.print("  ".join(f"{name} {_short(value)}" for name, value in shown.items()))
    console.print(f"Written to {path}.")


def read_lines(path: Path) -> list[dict[str, Any]]:
    """Read back what :func:`write_lines` wrote."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def routing_table(records: Iterable[dict[str, Any]]) -> list[list[str]]:
    """Return a row for each instance and a column for each method: time, proof and runtime."""
    cells: dict[tuple[str, str], dict[str, str]] = {}
    methods: list[str] = []
    for record in records:
        if record["method"] not in methods:
            methods.append(record["method"])
        instance = f"{record['farm']}, {record['turbines']}", str(record["stations"])
        cells.setdefault(instance, {})[record["method"]] = _cell(record)
    rows = [[*instance, *(row.get(m, "") for m in methods)] for instance, row in cells.items()]
    return [["farm, turbines", "K", *methods], *rows]


def write_table(rows: Iterable[list[str]], path: Path) -> None:
    """Write a table that the documentation includes."""
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def _cell(record: dict[str, Any]) -> str:
    if record["status"] == "failed":
        return "failed"
    proof = "optimal" if record["status"] == "optimal" else f"gap {record['gap']:.1%}"
    return f"{record['objective']:.1f} s, {proof}, {record['runtime']:.1f} s"


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
