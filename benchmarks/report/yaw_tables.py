"""Tables of yaw lines: what windopt's set-points gain beside FLORIS's, and how much faster.

A gain is a share of what the farm delivers facing the wind, and gains differ by points, per cent of
the same. Every power is FLORIS's own, whoever found the set-points.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import mean, median

from benchmarks.case import Record
from benchmarks.report.routing_tables import Rows, answered, failures

FLORIS = "floris"
OURS = {"nlp": "nonlinear program", "serial-refine": "serial refine on compiled wakes"}
"""Methods of windopt, and what the tables call them."""

NEAR = 0.02
"""How many points below FLORIS's a gain may be and still count as no less."""

EQUAL = 1e-4
"""Points within which two gains are one."""


@dataclass(frozen=True)
class Pair:
    """A method's line and FLORIS's on the same instance."""

    mine: Record
    floris: Record

    @property
    def points(self) -> float:
        """How many points more the method gains."""
        return 100 * float(self.mine["gain"] - self.floris["gain"])

    @property
    def times_faster(self) -> float:
        """FLORIS's processor time over the method's."""
        return float(self.floris["cpu"] / self.mine["cpu"])

    @property
    def kind(self) -> tuple[int, str]:
        """Turbines, and whether they are set for one wind, a table of them, a scatter or steps."""
        last = self.mine["instance"].rpartition("-")[2]
        return self.mine["turbines"], "one wind" if last.isdigit() else last


def tables(records: Sequence[Record]) -> dict[str, Rows]:
    """Return the tables by title; one that has no rows is left out."""
    found = {
        "Over all instances": summary(records),
        "Times faster than FLORIS, by size": by_size(records),
        "Where FLORIS's set-points gain more": where_floris_gains_more(records),
        **{f"FLORIS and the {name}": beside_floris(records, m) for m, name in OURS.items()},
        "Cases that failed": failures(records),
    }
    return {title: rows for title, rows in found.items() if len(rows) > 1}


def beside_floris(records: Sequence[Record], method: str) -> Rows:
    """Return a row for each instance: gains and processor times of FLORIS and a method."""
    rows = [
        ["instance", "turbines", "winds", "FLORIS: gain", "s", "windopt: gain", "s",
         "times faster", "points more", "bound over power"]
    ]  # fmt: skip
    for name, lines in _by_instance(records).items():
        about: Record = next(iter(answered(lines.values())), {})
        comparison = ["-", "-"]
        for pair in _pairs(list(lines.values()), method):
            comparison = [_number(pair.times_faster), f"{pair.points:+.3f}"]
        rows.append(
            [name, *(str(about.get(fact, "-")) for fact in ("turbines", "winds")),
             *_answer(lines, FLORIS), *_answer(lines, method), *comparison, _room(lines, method)]
        )  # fmt: skip
    return rows


def summary(records: Sequence[Record]) -> Rows:
    """Return a row for each method, over the instances that FLORIS answered too."""
    rows = [
        ["method", "cases", "failed", f"gain no less than FLORIS's - {NEAR} points", "mean gain",
         "FLORIS's mean gain", "points more: mean", "least", "most"]
    ]  # fmt: skip
    for method, name in OURS.items():
        failed = sum(r["method"] == method and r["status"] == "failed" for r in records)
        pairs = _pairs(records, method)
        points = [pair.points for pair in pairs]
        near = sum(more >= -NEAR for more in points)
        if pairs:
            rows.append(
                [name, str(len(pairs)), str(failed), f"{near} of {len(pairs)}",
                 f"{mean(pair.mine['gain'] for pair in pairs):.3%}",
                 f"{mean(pair.floris['gain'] for pair in pairs):.3%}",
                 *(f"{of(points):+.3f}" for of in (mean, min, max))]
            )  # fmt: skip
    return rows


def by_size(records: Sequence[Record]) -> Rows:
    """Return a row for each method, number of turbines and kind: how many times faster it is."""
    rows = [
        ["method", "turbines", "set for", "cases", "FLORIS: median s", "windopt: median s",
         "times faster: least", "median", "most"]
    ]  # fmt: skip
    for method, name in OURS.items():
        kinds: dict[tuple[int, str], list[Pair]] = defaultdict(list)
        for pair in _pairs(records, method):
            kinds[pair.kind].append(pair)
        for (turbines, kind), pairs in sorted(kinds.items()):
            times = [pair.times_faster for pair in pairs]
            rows.append(
                [name, str(turbines), kind, str(len(pairs)),
                 _number(median(pair.floris["cpu"] for pair in pairs)),
                 _number(median(pair.mine["cpu"] for pair in pairs)),
                 *(_number(of(times)) for of in (min, median, max))]
            )  # fmt: skip
    return rows


def where_floris_gains_more(records: Sequence[Record]) -> Rows:
    """Return a row for each answer that gains less than FLORIS's, the farthest behind first."""
    behind = [pair for method in OURS for pair in _pairs(records, method) if pair.points < -EQUAL]
    rows = [["instance", "method", "points less"]]
    return rows + [
        [pair.mine["instance"], OURS[pair.mine["method"]], f"{-pair.points:.4f}"]
        for pair in sorted(behind, key=lambda pair: pair.points)
    ]


def not_measured(records: Sequence[Record], instances: Sequence[str]) -> Rows:
    """Return a row for each of these instances that lacks a line of some method."""
    known = _by_instance(records)
    rows = [["instance", "methods"]]
    for name in instances:
        if absent := [method for method in (FLORIS, *OURS) if method not in known.get(name, {})]:
            rows.append([name, ", ".join(absent)])
    return rows


def _by_instance(records: Sequence[Record]) -> Mapping[str, Mapping[str, Record]]:
    """Return the lines of each instance by method; of several the last one counts."""
    lines: dict[str, dict[str, Record]] = defaultdict(dict)
    for record in records:
        lines[record["instance"]][record["method"]] = record
    return lines


def _pairs(records: Sequence[Record], method: str) -> list[Pair]:
    found = _by_instance(answered(records)).values()
    return [Pair(line[method], line[FLORIS]) for line in found if {method, FLORIS} <= line.keys()]


def _answer(lines: Mapping[str, Record], method: str) -> list[str]:
    if method not in lines:
        return ["not measured", "-"]
    record = lines[method]
    if record["status"] == "failed":
        return ["failed", "-"]
    return [f"{record['gain']:.3%}", _number(record["cpu"])]


def _room(lines: Mapping[str, Record], method: str) -> str:
    record = lines.get(method, {})
    return f"{record['bound'] / record['power']:.3f}" if record.get("bound") else "-"


def _number(value: float) -> str:
    """Return a number with the digits that say something."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"
