"""What the tables of every problem ask of lines."""

from collections import defaultdict
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

from benchmarks.case import Record
from benchmarks.records import read_lines
from benchmarks.runner import key

Shared = TypeVar("Shared")
Rows = list[list[str]]
"""A table whose first row is its head."""
TIMES = "runtime", "cpu"
"""Wall and processor time of a line [s]; not every problem tells both."""


def all_lines(folder: Path) -> list[Record]:
    """Read the lines of a folder; of several lines of one case the last counts."""
    files = sorted(folder.glob("*.jsonl"))
    return list({key(record): record for file in files for record in read_lines(file)}.values())


def answered(records: Iterable[Record]) -> list[Record]:
    """Return the lines of methods that did not fail."""
    return [record for record in records if record["status"] != "failed"]


def failures(records: Iterable[Record]) -> Rows:
    """Return a row for each case that failed."""
    rows = [["problem", "instance", "method", "limit s", "reason"]]
    for record in records:
        if record["status"] == "failed":
            names = (record[name] for name in ("problem", "instance", "method"))
            rows.append([*names, f"{record['time_limit']:g}", record["reason"]])
    return rows


def runs(records: Iterable[Record]) -> Rows:
    """Return a row for each command: its cases, what they took, and the machine."""
    rows = [["command", "limit s", "cases", "failed", "wall h", "CPU h", "commit", "machine"]]
    kinds = grouped(records, lambda record: (record["command"], record["time_limit"]))
    for (command, limit), mine in kinds.items():
        hours = (sum(record.get(time, 0.0) for record in mine) / 3600 for time in TIMES)
        commits = dict.fromkeys(record["commit"] for record in mine)
        machines = dict.fromkeys(
            "{processor}, {processors} processors".format(**record["machine"]) for record in mine
        )
        rows.append(
            [f"``{command}``", f"{limit:g}", str(len(mine)), str(len(mine) - len(answered(mine))),
             *(f"{time:.2f}" if time else "-" for time in hours),
             ", ".join(commits), "; ".join(machines)]
        )  # fmt: skip
    return rows


def number(value: float | None, otherwise: float) -> float:
    """Return a number of a line, where ``null`` stands for an infinite one."""
    return otherwise if value is None else value


def grouped(
    records: Iterable[Record], by: Callable[[Record], Shared]
) -> dict[Shared, list[Record]]:
    """Return the lines by what they share, such as wind and dwell."""
    groups: dict[Shared, list[Record]] = defaultdict(list)
    for record in records:
        groups[by(record)].append(record)
    return groups
