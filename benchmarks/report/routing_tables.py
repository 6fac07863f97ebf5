"""Tables of routing lines: plans measured by the best bound that any method proved."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, nan
from statistics import median

from benchmarks.case import Record

Rows = list[list[str]]
Instance = tuple[str, str]

LP = "-lp"
"""How the names of methods end that solve a linear relaxation and plan nothing."""

COLUMNS = "exact"
"""The method whose linear relaxation has a column for each flight."""

PROVED = 1e-6
"""Relative gap below which bound and plan are one."""


@dataclass(frozen=True)
class Best:
    """The best plan and the best bound known of an instance [s]."""

    objective: float = inf
    bound: float = -inf

    @property
    def gap(self) -> float:
        """How far the plan can be from the best, as a fraction of it [-]."""
        return (self.objective - self.bound) / self.objective if isfinite(self.objective) else nan


def instance(record: Record) -> Instance:
    """Return what tells an instance from all others: name and fingerprint."""
    return record["instance"], record.get("hash", "")


def answered(records: Iterable[Record]) -> list[Record]:
    """Return the lines of methods that did not fail."""
    return [record for record in records if record["status"] != "failed"]


def best_known(records: Iterable[Record]) -> dict[Instance, Best]:
    """Return the best plan and bound of each instance over all lines."""
    known: dict[Instance, Best] = defaultdict(Best)
    for record in answered(records):
        so_far = known[instance(record)]
        known[instance(record)] = Best(
            min(so_far.objective, number(record["objective"], inf)),
            max(so_far.bound, number(record["bound"], -inf)),
        )
    return known


def number(value: float | None, otherwise: float) -> float:
    """Return a number of a line, where ``null`` stands for an infinite one."""
    return otherwise if value is None else value


def proved(record: Record) -> bool:
    """Whether the line is of a plan that its own method proved."""
    return bool(record["status"] == "optimal")


def above(record: Record, best: Best) -> float:
    """Return how far a line's plan is above the best bound known, as a fraction of it [-]."""
    objective = number(record["objective"], inf)
    return max(0.0, objective - best.bound) / best.bound if best.bound > 0 else nan


def by_method(records: Sequence[Record]) -> Rows:
    """Return a row for each method: how often it proved its plan, and how far plans are off."""
    known = best_known(records)
    rows = [
        ["method", "cases", "failed", "proved", "median s to proof", "of a processor",
         "plan above bound: median", "mean", "worst", "is the best plan"]
    ]  # fmt: skip
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        found = [record for record in answered(mine) if record["objective"] is not None]
        gaps = [above(record, known[instance(record)]) for record in found]
        times = [record["runtime"] for record in found if proved(record)]
        busy = [record["cpu"] for record in found if proved(record)]
        best = sum(
            record["objective"] <= known[instance(record)].objective * (1 + PROVED)
            for record in found
        )
        rows.append(
            [method, str(len(mine)), str(len(mine) - len(answered(mine))), str(len(times)),
             _median(times), _median(busy), *_shares(gaps), str(best)]
        )  # fmt: skip
    return rows


def _median(times: Sequence[float]) -> str:
    return f"{median(times):.1f}" if times else "-"


def _shares(gaps: Sequence[float]) -> list[str]:
    if not gaps:
        return ["-"] * 3
    return [f"{value:.2%}" for value in (median(gaps), sum(gaps) / len(gaps), max(gaps))]


def methods(records: Iterable[Record]) -> list[str]:
    """Return the methods that plan, in the order in which they come."""
    names = dict.fromkeys(record["method"] for record in records)
    return [name for name in names if not name.endswith(LP)]


def by_instance(records: Sequence[Record]) -> Rows:
    """Return a row for each instance: the best known, and each method's distance and time."""
    known, planned = best_known(records), methods(records)
    cells: dict[Instance, dict[str, str]] = defaultdict(dict)
    facts: dict[Instance, Record] = {}
    for record in records:
        name = instance(record)
        cells[name][record["method"]] = _cell(record, known[name])
        if record["status"] != "failed":
            facts.setdefault(name, record)
    rows = [["farm", "n", "K", "out of reach", "best plan s", "best bound s", *planned]]
    for name, about in sorted(facts.items(), key=lambda item: (item[1]["turbines"], item[0])):
        best = known[name]
        rows.append(
            [about["farm"], str(about["turbines"]), str(about["stations"]),
             str(about["unreachable"]), f"{best.objective:.2f}", f"{best.bound:.2f}",
             *(cells[name].get(method, "") for method in planned)]
        )  # fmt: skip
    return rows


def _cell(record: Record, best: Best) -> str:
    if record["status"] == "failed" or record["objective"] is None:
        return str(record["status"]).replace("_", " ")
    distance = "proved" if proved(record) else f"{above(record, best):.2%}"
    return f"{distance}, {record['runtime']:.1f} s"


def relaxations(records: Sequence[Record]) -> Rows:
    """Return a row for each instance whose relaxations were solved: bound over best plan."""
    known = best_known(records)
    lps = dict.fromkeys(r["method"] for r in records if r["method"].endswith(LP))
    cells: dict[Instance, dict[str, str]] = defaultdict(dict)
    for record in answered(records):
        best = known[instance(record)].objective
        if record["method"] in lps and isfinite(best):
            cells[instance(record)][record["method"]] = f"{number(record['bound'], 0) / best:.1%}"
        elif record.get("lp_bound") and record["method"] == COLUMNS and isfinite(best):
            cells[instance(record)][COLUMNS] = f"{record['lp_bound'] / best:.1%}"
    if any(COLUMNS in row for row in cells.values()):
        lps[COLUMNS] = None
    rows = [["instance", *(name.removesuffix(LP) for name in lps)]]
    return rows + [[name[0], *(row.get(lp, "-") for lp in lps)] for name, row in cells.items()]


def failures(records: Iterable[Record]) -> Rows:
    """Return a row for each case that failed."""
    rows = [["problem", "instance", "method", "limit s", "reason"]]
    for record in records:
        if record["status"] == "failed":
            names = (record[name] for name in ("problem", "instance", "method"))
            rows.append([*names, f"{record['time_limit']:g}", record["reason"]])
    return rows


def settings(
    records: Iterable[Record], of: Callable[[Record], tuple[float, ...]]
) -> dict[tuple[float, ...], list[Record]]:
    """Return the lines by a setting they share, such as wind and dwell."""
    groups: dict[tuple[float, ...], list[Record]] = defaultdict(list)
    for record in records:
        groups[of(record)].append(record)
    return groups
