"""The paper's four tables, made anew: forecasting, bits, yaw, and routing.

Each row is a case, named by its table and itself: ``yaw/hour ahead``. What the rows are made of is
told in :mod:`benchmarks.forecast_cases`, :mod:`benchmarks.closed_loop` and
:mod:`benchmarks.reconstructed`.
"""

from collections.abc import Sequence
from dataclasses import replace

from benchmarks import closed_loop, forecast_cases
from benchmarks.case import Case, Problem, Record
from benchmarks.processor import processor_time
from benchmarks.reconstructed import COORDINATES, PLANNERS, example
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection

SERIES = "wrf-2009-01"
WIND = Wind.from_met(10.0, 90.0)
LIMITS = {"small": 600.0, "medium": 600.0, "full": 600.0}
OURS = "ours"
"""The only method: the rows differ by what they are about."""

FORECASTERS = tuple(name for name in forecast_cases.METHODS if not name.startswith("lstm-raw"))
"""Those of the paper's tables, and what they must be better than."""


def instances() -> Sequence[str]:
    """Return the rows of all tables."""
    return [
        *(f"forecast/{name}" for name in FORECASTERS),
        *(f"yaw/{name}" for name in closed_loop.FORECASTERS),
        *(f"routing on {where}/{name}" for where in COORDINATES for name in PLANNERS),
    ]


def measure(case: Case) -> Record:
    """Make a row."""
    table, _, row = case.instance.partition("/")
    if table == "forecast":
        return forecast_cases.measure(replace(case, instance=SERIES, method=row))
    if table == "yaw":
        return closed_loop.loop(row)
    return _flown(table.removeprefix("routing on "), row, case)


def _flown(where: str, planner: str, case: Case) -> Record:
    """Plan the example under the paper's speed rule."""
    farm, fleet = example(COORDINATES[where]())
    began = processor_time()
    result = plan_inspection(
        farm, fleet, WIND, method=PLANNERS[planner], rule="paper", time_limit=case.time_limit
    )
    plan = result.found()
    return {
        "status": str(result.status),
        "minutes": result.objective / 60,
        "bound_minutes": result.bound / 60,
        "flights": ["-".join((f.station, *f.turbines, f.station)) for f in plan.flights],
        "unreachable": [left.turbine for left in plan.unreachable],
        "cpu": round(processor_time() - began, 3),
    }


def show(records: Sequence[Record]) -> str:
    """Return the four tables as text, ours beside the paper's."""
    from benchmarks.report.columns import as_text
    from benchmarks.report.paper_tables import TABLES

    return "\n\n".join(as_text(title, make(records)) for title, make in TABLES.items())


PROBLEM = Problem(
    instances=lambda chosen: instances() if chosen in LIMITS else (),
    methods=lambda chosen: (OURS,),
    time_limits=LIMITS,
    measure=measure,
    show=show,
)
