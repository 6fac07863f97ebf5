"""What all routing lines together know of an instance: the best plan, and the best bound.

A heuristic is measured by what any method proved in any time, so a line of five minutes tells how
good a plan of ten seconds is.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite, nan

from benchmarks.case import Record
from benchmarks.inspections import NAME
from benchmarks.report.lines import Rows, answered, number

Instance = tuple[str, str]

LP = "-lp"
"""How the names of methods end that solve a linear relaxation and plan nothing."""

PROVED = 1e-6
"""Relative gap below which bound and plan are one."""

FACTS = "hash", "farm", "turbines", "stations", "wind_speed", "wind_direction", "dwell"
"""What every line of an instance says but those of cases that failed."""


@dataclass(frozen=True)
class Best:
    """The best plan and the best bound known of an instance [s]."""

    objective: float = inf
    bound: float = -inf

    @property
    def gap(self) -> float:
        """How far the plan can be from the best, as a fraction of it [-]."""
        return (self.objective - self.bound) / self.objective if isfinite(self.objective) else nan

    @property
    def proved(self) -> bool:
        """Whether the plan is proved the best."""
        return self.gap <= PROVED


Known = Mapping[Instance, Best]


def instance(record: Record) -> Instance:
    """Return what tells an instance from all others: name and fingerprint."""
    return record["instance"], record.get("hash", "")


def handle(record: Record) -> str:
    """Return the farm of a line by the handle in its instance's name, which failed cases have too.

    The name as a whole where it is of another form.
    """
    parts = NAME.fullmatch(record["instance"])
    return parts["farm"] if parts else str(record["instance"])


def complete(records: Iterable[Record]) -> list[Record]:
    """Return the lines, those of failed cases with what others say of the same instance."""
    lines = list(records)
    told = {record["instance"]: record for record in answered(lines)}
    return [
        {name: told[record["instance"]].get(name) for name in FACTS} | record
        if record["status"] == "failed" and record["instance"] in told
        else record
        for record in lines
    ]


def best_known(records: Iterable[Record]) -> Known:
    """Return the best plan and bound of each instance over all lines."""
    known: dict[Instance, Best] = defaultdict(Best)
    for record in answered(records):
        so_far = known[instance(record)]
        known[instance(record)] = Best(
            min(so_far.objective, number(record["objective"], inf)),
            max(so_far.bound, number(record["bound"], -inf)),
        )
    return known


def proved(record: Record) -> bool:
    """Whether the line is of a plan that its own method proved."""
    return bool(record["status"] == "optimal")


def planned(records: Iterable[Record]) -> list[Record]:
    """Return the lines that have a plan."""
    return [record for record in answered(records) if record["objective"] is not None]


def measurable(records: Iterable[Record], known: Known) -> list[Record]:
    """Return the lines of instances of which both a plan and a bound are known."""
    return [
        record
        for record in records
        if known[instance(record)].bound > 0 and isfinite(known[instance(record)].objective)
    ]


def above(record: Record, best: Best) -> float:
    """Return how far a line's plan is above the best bound known, as a fraction of it [-].

    Infinitely far where no bound is known.
    """
    objective = number(record["objective"], inf)
    return max(0.0, objective - best.bound) / best.bound if best.bound > 0 else inf


def methods(records: Iterable[Record]) -> list[str]:
    """Return the methods that plan, in the order in which they come."""
    names = dict.fromkeys(record["method"] for record in records)
    return [name for name in names if not name.endswith(LP)]


def compared(records: Sequence[Record]) -> dict[tuple[str, ...], list[Record]]:
    """Return, for each set of methods that ran together, their lines where all of them ran.

    Methods that ran on all farms are so compared on all of them, and beside others on the farms
    that were left to those. The set that ran on most instances comes first.
    """
    ran: dict[Instance, dict[str, None]] = defaultdict(dict)
    for record in records:
        ran[instance(record)][record["method"]] = None
    together = {frozenset(names): tuple(names) for names in ran.values()}
    groups = {
        names: [r for r in records if r["method"] in same and ran[instance(r)].keys() >= same]
        for same, names in together.items()
    }
    return dict(sorted(groups.items(), key=lambda group: len(group[0])))


def contradictions(records: Iterable[Record], known: Known) -> Rows:
    """Return a row for each plan that is better than a bound proved for its instance."""
    rows = [["instance", "method", "plan s", "best bound s"]]
    for record in planned(records):
        bound = known[instance(record)].bound
        if record["objective"] < bound * (1 - PROVED):
            rows.append([record["instance"], record["method"], f"{record['objective']:.3f}",
                         f"{bound:.3f}"])  # fmt: skip
    return rows
