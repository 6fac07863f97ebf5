"""Tables of forecast lines: errors, size and training of each forecaster, and its time at the edge.

The paper's tables are made of the same cases (:mod:`benchmarks.paper`), so their lines count here
as well.
"""

from collections.abc import Mapping, Sequence

from benchmarks.case import Record
from benchmarks.report.lines import Rows, answered
from benchmarks.report.paper_tables import ERRORS, FIELDS, rows_of


def scored(records: Sequence[Record]) -> Mapping[str, Record]:
    """Return the line of each forecaster by name; the paper's where there is no other."""
    mine = {r["method"]: r for r in answered(records) if r["problem"] == "forecast"}
    papers = rows_of(records, "forecast").items()
    return mine | {name: record for name, record in papers if name not in mine}


def forecasters(records: Sequence[Record]) -> Rows:
    """Return a row for each forecaster."""
    rows = [
        ["forecaster", "speed MAE m/s", "direction MAE deg",
         *(f"{error}, normalised" for error in ERRORS), "bytes", "CPU s to train"]
    ]  # fmt: skip
    for name, record in scored(records).items():
        normalised = (f"{record['normalised'][field]:.4f}" for field in FIELDS)
        errors = f"{record['speed_mae']:.3f}", f"{record['direction_mae']:.2f}", *normalised
        rows.append([name, *errors, str(record["bytes"] or "-"), f"{record['cpu']:.1f}"])
    return rows


def networks(records: Sequence[Record]) -> Rows:
    """Return a row for each way to run the network on one window."""
    rows = [["network", "microseconds", "bytes"]]
    for record in answered(records):
        if record["problem"] == "edge":
            rows += [
                [one["network"], *(_whole(one[fact]) for fact in ("microseconds", "bytes"))]
                for one in record["networks"]
            ]
    return rows


def _whole(value: float | None) -> str:
    return f"{value:.0f}" if value else "-"
