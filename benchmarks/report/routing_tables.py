"""Tables of routing lines: plans measured by the best bound that any line proved."""

from collections import defaultdict
from collections.abc import Callable, Sequence
from math import inf, isfinite
from statistics import mean, median

from benchmarks.case import Record
from benchmarks.report.best_known import (
    LP,
    PROVED,
    Best,
    Instance,
    Known,
    above,
    handle,
    instance,
    methods,
    planned,
    proved,
)
from benchmarks.report.lines import Rows, answered, grouped, number

COLUMNS = "exact"
"""The method whose linear relaxation has a column for each flight."""


def by_method(records: Sequence[Record], known: Known) -> Rows:
    """Return a row for each method: what it proved, what a plan cost, and how far plans are off."""
    rows = [
        ["method", "cases", "failed", "proved", "wall s to proof: median", "CPU s a plan: median",
         "mean", "plan above bound: median", "mean", "worst", "is the best plan"]
    ]  # fmt: skip
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        found = planned(mine)
        gaps = [above(record, known[instance(record)]) for record in found]
        times = [record["runtime"] for record in found if proved(record)]
        busy = [record["cpu"] for record in found]
        best = sum(_at(record, known[instance(record)].objective) for record in found)
        rows.append(
            [method, str(len(mine)), str(len(mine) - len(answered(mine))), str(len(times)),
             _seconds(times, median), _seconds(busy, median), _seconds(busy, mean),
             *_shares(gaps), str(best)]
        )  # fmt: skip
    return rows


def beside_optima(records: Sequence[Record], known: Known) -> Rows:
    """Return a row for each method, over the instances whose optimum some line proved."""
    rows = [
        ["method", "cases with a proved optimum", "optimum found", "share",
         "above the optimum: median", "mean", "worst"]
    ]  # fmt: skip
    for method in methods(records):
        mine = [r for r in records if r["method"] == method and known[instance(r)].proved]
        found = planned(mine)
        if mine:
            optimal = sum(_at(record, known[instance(record)].objective) for record in found)
            gaps = [above(record, known[instance(record)]) for record in found]
            rows.append(
                [method, str(len(mine)), str(optimal), f"{optimal / len(mine):.0%}", *_shares(gaps)]
            )
    return rows


def _at(record: Record, objective: float) -> bool:
    return bool(record["objective"] <= objective * (1 + PROVED))


def _seconds(times: Sequence[float], of: Callable[[Sequence[float]], float]) -> str:
    return f"{of(times):.1f}" if times else "-"


def _shares(gaps: Sequence[float]) -> list[str]:
    return [_share(of(gaps)) for of in (median, mean, max)] if gaps else ["-"] * 3


def _share(gap: float) -> str:
    return f"{gap:.2%}" if isfinite(gap) else "no bound"


def by_instance(records: Sequence[Record], known: Known) -> Rows:
    """Return a row for each instance: the best known, and each method's distance and time."""
    shown = methods(records)
    found = []
    for name, lines in grouped(records, instance).items():
        best, about = known[name], next(iter(answered(lines)), lines[0])
        cells = {record["method"]: _cell(record, best) for record in lines}
        row = [*_farm(about), _finite(best.objective), _finite(best.bound),
               *(cells.get(method, "") for method in shown)]  # fmt: skip
        found.append((about.get("turbines") or inf, name, row))
    head = ["farm", "n", "K", "out of reach", "best plan s", "best bound s", *shown]
    return [head, *(row for *_, row in sorted(found))]


def _farm(record: Record) -> list[str]:
    """Return name, turbines, stations and what is out of reach, as far as a failed case tells."""
    facts = ("turbines", "stations", "unreachable")
    return [record.get("farm") or handle(record), *(str(record.get(fact, "-")) for fact in facts)]


def _finite(value: float) -> str:
    return f"{value:.2f}" if isfinite(value) else "-"


def _cell(record: Record, best: Best) -> str:
    if record["status"] == "failed" or record["objective"] is None:
        return str(record["status"]).replace("_", " ")
    distance = "proved" if proved(record) else _share(above(record, best))
    return f"{distance}, {record['runtime']:.1f} s"


def relaxations(records: Sequence[Record], known: Known) -> Rows:
    """Return a row for each instance whose relaxations were solved: bound over best plan."""
    shares = _relaxed(records, known)
    lps = list(dict.fromkeys(lp for row in shares.values() for lp in row))
    cells = {name: [f"{row[lp]:.1%}" if lp in row else "-" for lp in lps]
             for name, row in shares.items()}  # fmt: skip
    return [["instance", *lps], *([name[0], *row] for name, row in cells.items())]


def relaxation_strength(records: Sequence[Record], known: Known) -> Rows:
    """Return a row for each formulation: what share of the best plan its linear relaxation is."""
    by_formulation: dict[str, list[float]] = defaultdict(list)
    for row in _relaxed(records, known).values():
        for lp, share in row.items():
            by_formulation[lp].append(share)
    return [["formulation", "instances", "least", "median", "most"]] + [
        [lp, str(len(shares)), *(f"{of(shares):.1%}" for of in (min, median, max))]
        for lp, shares in by_formulation.items()
    ]


def _relaxed(records: Sequence[Record], known: Known) -> dict[Instance, dict[str, float]]:
    """Return bound over best plan by instance and formulation, where relaxations were asked for."""
    shares: dict[Instance, dict[str, float]] = defaultdict(dict)
    for record in answered(records):
        name, method = instance(record), record["method"]
        if method.endswith(LP) and isfinite(known[name].objective):
            share = number(record["bound"], 0.0) / known[name].objective
            shares[name][method.removesuffix(LP)] = share
    for record in answered(records):
        if (name := instance(record)) in shares and record["method"] == COLUMNS:
            bound = number(record.get("lp_bound"), -inf)
            if isfinite(bound):
                shares[name][COLUMNS] = bound / known[name].objective
    return shares
