"""The pages of inspection routing: real farms, whole farms, every case, and growing grids."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.case import Record
from benchmarks.report import plots, rst
from benchmarks.report.best_known import (
    best_known,
    compared,
    complete,
    contradictions,
    instance,
    measurable,
    methods,
)
from benchmarks.report.farm_tables import (
    every_farm,
    named,
    proofs,
    setting,
    unproved,
    whole_farms,
)
from benchmarks.report.lines import failures, grouped
from benchmarks.report.routing_tables import (
    beside_optima,
    by_instance,
    by_method,
    relaxation_strength,
    relaxations,
)

GRID = "grid"


def real_farms(records: Sequence[Record]) -> list[Record]:
    """Return the routing lines of real farms."""
    return complete(
        record
        for record in records
        if record["problem"] == "routing" and not record["instance"].startswith(GRID)
    )


def routing_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of inspection routing on real farms: what methods prove, and how far off."""
    mine = real_farms(records)
    if not mine:
        return
    yield rst.title("Inspection flights of real farms")
    yield ROUTING
    yield from _proofs(mine, out)
    for number, same in enumerate(_side_by_side(mine), 1):
        yield from _comparison(same, mine, out, number)
    yield rst.filled("Plans below a bound that was proved", contradictions(mine, best_known(mine)))
    yield rst.filled("Cases that failed", failures(mine))
    yield rst.origin(mine)


def _proofs(mine: Sequence[Record], out: Path) -> Iterator[str]:
    farms = whole_farms(mine)
    if not farms:
        return
    yield rst.title(f"What the exact method proves in {farms[0]['time_limit']:g} s", "-")
    yield PROOFS
    yield rst.table("Plans proved to be the best", proofs(farms))
    yield rst.picture(
        plots.growth_by_dwell, farms, best_known(mine), path=out / "routing-farms.png"
    )


def _side_by_side(mine: Sequence[Record]) -> list[list[Record]]:
    """Return the lines of methods that ran on the same instances with the same limit."""
    return [
        same
        for _, group in sorted(_by_limit(mine).items())
        for together, same in compared(group).items()
        if len(together) > 1
    ]


def _comparison(
    same: Sequence[Record], mine: Sequence[Record], out: Path, number: int
) -> Iterator[str]:
    """Yield the section of this number, on methods that ran side by side."""
    known = best_known(mine)
    instances = len({record["instance"] for record in same})
    count = len(methods(same))
    limit = same[0]["time_limit"]
    yield rst.title(f"{count} methods with {limit:g} s each, on {instances} instances", "-")
    yield rst.table("Plans beside the best bound", by_method(same, known))
    yield rst.filled("Plans beside the optimum, where it is proved", beside_optima(same, known))
    left_out = instances - len({instance(record) for record in measurable(same, known)})
    note = LEFT_OUT.format(count=left_out) if left_out else ""
    for kind, draw in PICTURES.items():
        yield rst.picture(draw, same, known, path=out / f"routing-{kind}-{number}.png")
    for kind, draw in OVER_TIME.items():
        yield rst.picture(draw, same, known, path=out / f"routing-{kind}-{number}.png", note=note)
    strength = relaxation_strength(same, known)
    yield rst.filled("Linear relaxations, as a share of the best plan known", strength)


def farms_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page with the exact method's answer for every farm."""
    farms = whole_farms(real_farms(records))
    if not farms:
        return
    yield rst.title("Whole farms, one by one")
    yield FARMS.format(limit=farms[0]["time_limit"])
    yield rst.filled("Not proved, the smallest gap first", unproved(farms))
    for key, same in sorted(grouped(farms, setting).items()):
        yield rst.table(named(key), every_farm(same))
    yield rst.origin(farms)


def cases_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page with every method's plan for every instance."""
    mine = real_farms(records)
    known = best_known(mine)
    sections = _side_by_side(mine)
    if not sections:
        return
    yield rst.title("Methods side by side, case by case")
    yield CASES
    for same in sections:
        limit = same[0]["time_limit"]
        yield rst.title(f"{len(methods(same))} methods with {limit:g} s each", "-")
        for key, cases in sorted(grouped(same, setting).items()):
            yield rst.table(named(key), by_instance(cases, known))
        shares = relaxations(same, known)
        yield rst.filled("Linear relaxations, as a share of the best plan known", shares)


def growth_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page on how times grow with the number of turbines."""
    routing = [record for record in records if record["problem"] == "routing"]
    grids = complete(record for record in routing if record["instance"].startswith(GRID))
    if not grids:
        return
    known = best_known(grids)
    yield rst.title("How times grow with the farm")
    yield GROWTH
    for limit, same in sorted(_by_limit(grids).items()):
        yield rst.title(f"With {limit:g} s for each answer", "-")
        yield rst.picture(plots.growth, same, known, path=out / f"growth-{limit:g}.png")
        yield rst.table("Square grids, 1 km between neighbours", by_instance(same, known))
        yield rst.filled("Plans beside the optimum, where it is proved", beside_optima(same, known))
    yield rst.filled("Cases that failed", failures(grids))
    yield rst.origin(grids)


def _by_limit(records: Sequence[Record]) -> dict[float, list[Record]]:
    return grouped(records, lambda record: float(record["time_limit"]))


PICTURES = {
    "profile": plots.profile,
    "distances": plots.distances,
}
OVER_TIME = {
    "gaps": plots.gap_over_time,
    "bounds": plots.bound_over_time,
}
LEFT_OUT = "Instances of which no plan or no bound is known are left out for all methods: {count}."

ROUTING = """\
Every answer has passed the independent checker. Plans are measured by the best bound that any
method proved for the instance in any of the times below, so 0 % is optimal whoever found it;
"proved" means that the method itself proved its plan in its own time. PyVRP and OR-tools use all
of their time and prove nothing. :doc:`/benchmarks/protocol` says how this was measured,
:doc:`/benchmarks/generated/routing-cases` has every case.
"""

PROOFS = """\
A farm's plan covers every turbine within reach, from all of its stations together. A gap is how
far the plan can be from the best, as a share of it. :doc:`/benchmarks/generated/routing-farms`
has every farm.
"""

FARMS = """\
The exact method's answers within {limit:g} s. A farm has n turbines and K stations, and turbines
out of reach are left out. "optimal" is proved; otherwise no plan is below the bound, and the gap
is the share of the plan that is open. Wall s are what the limit is of, CPU s are of the processor.
"""

CASES = """\
A farm has n turbines and K stations. A cell says how far the method's plan is above the best
bound that any method proved in any time, or "proved" where the method proved its plan itself, and
the wall time it took.
"""

GROWTH = """\
Turbines in a square grid, one wind, stations by the same rule: only the number changes.
"""
