"""Tables of whole farms: which plans the exact method proved, and how far the others are off."""

from collections.abc import Sequence
from math import inf, nan
from statistics import median

from benchmarks.case import Record
from benchmarks.inspections import NAME
from benchmarks.report.best_known import handle, planned, proved
from benchmarks.report.lines import Rows, grouped, number
from benchmarks.report.routing_tables import COLUMNS

Setting = tuple[float, ...]
"""Wind speed [m/s], where it blows from [deg], and dwell [s]."""


def setting(record: Record) -> Setting:
    """Return wind and dwell, which a failed case says by its name only."""
    parts = NAME.fullmatch(record["instance"])
    return tuple(float(parts[name]) for name in ("speed", "direction", "dwell")) if parts else ()


def named(setting: Setting) -> str:
    """Return a setting in words."""
    speed, direction, dwell = setting
    wind = f"{speed:g} m/s from {direction:g} deg" if speed else "No wind"
    return f"{wind}, {dwell:g} s at each turbine"


def whole_farms(records: Sequence[Record]) -> list[Record]:
    """Return the exact method's lines with the longest limit, the smallest farms first."""
    exact = [record for record in records if record["method"] == COLUMNS]
    longest = max((record["time_limit"] for record in exact), default=0.0)
    mine = [record for record in exact if record["time_limit"] == longest]
    return sorted(mine, key=lambda record: (record.get("turbines") or 0, record["instance"]))


def proofs(records: Sequence[Record]) -> Rows:
    """Return a row for each wind and dwell: how many plans were proved, and the gaps of the rest.

    Wall times are of the proved plans; the last column is of all cases, one after the other.
    """
    rows = [
        ["wind and dwell", "proved", "wall s: median", "longest", "gap of the rest: median",
         "worst", "without a plan", "CPU hours of all"]
    ]  # fmt: skip
    for key, mine in sorted(grouped(records, setting).items()):
        times = [record["runtime"] for record in mine if proved(record)]
        gaps = [_gap(record) for record in planned(mine) if not proved(record)]
        spent = sum(record.get("cpu", 0.0) for record in mine) / 3600
        rows.append(
            [named(key), f"{len(times)} of {len(mine)}",
             *(f"{of(times):.1f}" if times else "-" for of in (median, max)),
             *(f"{of(gaps):.2%}" if gaps else "-" for of in (median, max)),
             str(len(mine) - len(planned(mine))), f"{spent:.2f}"]
        )  # fmt: skip
    return rows


def unproved(records: Sequence[Record]) -> Rows:
    """Return a row for each plan that was not proved, the smallest gap first."""
    rest = [record for record in planned(records) if not proved(record)]
    rows = [["farm", "n", "wind and dwell", "gap", "plan s", "bound s"]]
    return rows + [
        [record["farm"], str(record["turbines"]), named(setting(record)), f"{_gap(record):.2%}",
         f"{record['objective']:.2f}", f"{number(record['bound'], -inf):.2f}"]
        for record in sorted(rest, key=_gap)
    ]  # fmt: skip


def every_farm(records: Sequence[Record]) -> Rows:
    """Return a row for each case: size, status, plan, bound, gap and times."""
    rows = [["farm", "n", "K", "out of reach", "status", "plan s", "bound s", "gap", "wall s",
             "CPU s"]]  # fmt: skip
    for record in records:
        facts = ("turbines", "stations", "unreachable")
        rows.append(
            [record.get("farm") or handle(record), *(str(record.get(fact, "-")) for fact in facts),
             str(record["status"]).replace("_", " "), *_figures(record)]
        )  # fmt: skip
    return rows


def _figures(record: Record) -> list[str]:
    if record["status"] == "failed" or record["objective"] is None:
        return ["-"] * 5
    return [
        f"{record['objective']:.2f}",
        f"{number(record['bound'], -inf):.2f}",
        f"{_gap(record):.2%}",
        f"{record['runtime']:.1f}",
        f"{record['cpu']:.1f}",
    ]


def _gap(record: Record) -> float:
    objective, bound = record["objective"], number(record["bound"], nan)
    return float((objective - bound) / objective)
