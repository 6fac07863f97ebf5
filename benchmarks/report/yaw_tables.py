"""Tables of yaw lines: what windopt's set-points gain beside its rivals', and how much faster.

A gain is a share of what the farm delivers facing the wind, and gains differ by points, per cent of
the same. Every power is FLORIS's own, whoever found the set-points.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from statistics import mean, median

from benchmarks.case import Record
from benchmarks.report.lines import Rows, answered, failures

FLORIS = "floris"
OURS = {"nlp": "nonlinear program", "serial-refine": "serial refine on compiled wakes"}
"""Methods of windopt, and what the tables call them."""
RIVALS = {
    FLORIS: "FLORIS's serial refine",
    "floris-slsqp": "FLORIS's SLSQP",
    "slsqp": "SLSQP on windopt's wakes",
}
NAMES = {**OURS, "algorithm-1": "the paper's Algorithm 1", **RIVALS}
NEAR = 0.02
"""How many points below FLORIS's a gain may be and still count as no less."""

EQUAL = 1e-4
"""Points within which two gains are one."""


@dataclass(frozen=True)
class Pair:
    """A method's line and a rival's on the same instance, FLORIS's unless said otherwise."""

    mine: Record
    rival: Record

    @property
    def points(self) -> float:
        """How many points more the method gains."""
        return 100 * float(self.mine["gain"] - self.rival["gain"])

    @property
    def times_faster(self) -> float:
        """The rival's processor time over the method's."""
        return float(self.rival["cpu"] / self.mine["cpu"])

    @property
    def kind(self) -> tuple[int, str]:
        """Turbines, and whether they are set for one wind, a table of them, a scatter or steps."""
        last = self.mine["instance"].rpartition("-")[2]
        return self.mine["turbines"], "one wind" if last.isdigit() else last


def tables(records: Sequence[Record]) -> dict[str, Rows]:
    """Return the tables by title; one that has no rows is left out."""
    found = {
        "Over all instances that FLORIS refined": summary(records),
        "Every method: gain, and seconds of a processor": every_method(records),
        "Where a rival's set-points gain more": where_rivals_gain_more(records),
        "Times faster than FLORIS's serial refine, by size": by_size(records),
        "Cases that failed": failures(records),
    }
    return _with_rows(found)


def case_tables(records: Sequence[Record]) -> dict[str, Rows]:
    """Return the tables that have a row for each instance, by title."""
    found = {f"FLORIS and the {name}": beside_floris(records, m) for m, name in OURS.items()}
    return _with_rows(found)


def _with_rows(tables: dict[str, Rows]) -> dict[str, Rows]:
    return {title: rows for title, rows in tables.items() if len(rows) > 1}


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
    for method, name in NAMES.items():
        failed = sum(r["method"] == method and r["status"] == "failed" for r in records)
        pairs = _pairs(records, method)
        points = [pair.points for pair in pairs]
        near = sum(more >= -NEAR for more in points)
        if pairs and method != FLORIS:
            rows.append(
                [name, str(len(pairs)), str(failed), f"{near} of {len(pairs)}",
                 f"{mean(pair.mine['gain'] for pair in pairs):.3%}",
                 f"{mean(pair.rival['gain'] for pair in pairs):.3%}",
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
                 _number(median(pair.rival["cpu"] for pair in pairs)),
                 _number(median(pair.mine["cpu"] for pair in pairs)),
                 *(_number(of(times)) for of in (min, median, max))]
            )  # fmt: skip
    return rows


def every_method(records: Sequence[Record]) -> Rows:
    """Return a row for each instance that more methods than ours and FLORIS's were run on."""
    usual = {*OURS, FLORIS}
    lines = {name: by for name, by in _by_instance(records).items() if by.keys() - usual}
    shown = [method for method in NAMES if any(method in by for by in lines.values())]
    rows = [["instance", *(NAMES[method] for method in shown)]]
    return rows + [
        [name, *(_gain_and_time(by.get(method)) for method in shown)] for name, by in lines.items()
    ]


def where_rivals_gain_more(records: Sequence[Record]) -> Rows:
    """Return a row for each answer that gains less than a rival's, the farthest behind first."""
    beside = product(OURS, RIVALS)
    pairs = [pair for method, rival in beside for pair in _pairs(records, method, rival)]
    behind = [pair for pair in pairs if pair.points < -EQUAL]
    rows = [["instance", "method", "rival", "points less"]]
    return rows + [
        [pair.mine["instance"], OURS[pair.mine["method"]], NAMES[pair.rival["method"]],
         f"{-pair.points:.4f}"]
        for pair in sorted(behind, key=lambda pair: pair.points)
    ]  # fmt: skip


def not_measured(
    records: Sequence[Record], instances: Sequence[str], methods: Sequence[str]
) -> Rows:
    """Return a row for each of these instances that lacks a line of some of these methods."""
    known = _by_instance(records)
    rows = [["instance", "methods"]]
    for name in instances:
        if absent := [method for method in methods if method not in known.get(name, {})]:
            rows.append([name, ", ".join(absent)])
    return rows


def _by_instance(records: Sequence[Record]) -> Mapping[str, Mapping[str, Record]]:
    """Return the lines of each instance by method; of several the last one counts."""
    lines: dict[str, dict[str, Record]] = defaultdict(dict)
    for record in records:
        lines[record["instance"]][record["method"]] = record
    return lines


def _pairs(records: Sequence[Record], method: str, rival: str = FLORIS) -> list[Pair]:
    found = _by_instance(answered(records)).values()
    return [Pair(line[method], line[rival]) for line in found if {method, rival} <= line.keys()]


def _gain_and_time(record: Record | None) -> str:
    if record is None or record["status"] == "failed":
        return "failed" if record else "not measured"
    return f"{record['gain']:.3%}, {_number(record['cpu'])} s"


def _answer(lines: Mapping[str, Record], method: str) -> list[str]:
    if method not in lines:
        return ["not measured", "-"]
    record = lines[method]
    if record["status"] == "failed":
        return ["failed", "-"]
    return [f"{record['gain']:.3%}", _number(record["cpu"])]


def _room(lines: Mapping[str, Record], method: str) -> str:
    """Return the least bound that any method proved, over the power of this method's set-points."""
    bounds = [record["bound"] for record in lines.values() if record.get("bound")]
    power = lines.get(method, {}).get("power")
    return f"{min(bounds) / power:.3f}" if bounds and power else "-"


def _number(value: float) -> str:
    """Return a number with the digits that say something."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"
