"""How a command ends: the record on standard output and the exit code."""

from typing import Any

import typer

from windopt.cli import INTERRUPTED
from windopt.domain.plan import InspectionPlan
from windopt.io.plan_reader import Recorded
from windopt.io.plans import json_text, record_of
from windopt.result import Result, Status

DONE, FAILED, BAD_INPUT, UNVERIFIED = 0, 1, 2, 3


def print_record(plan: Recorded) -> None:
    """Print a plan's record as JSON."""
    typer.echo(json_text(record_of(plan)), nl=False)


def exit_code(result: Result[Any]) -> int:
    """Return the exit code of a result: 1 where there is no plan, or none flies."""
    plan = result.solution
    if plan is None and result.status is Status.INTERRUPTED:
        return INTERRUPTED
    nothing_flies = isinstance(plan, InspectionPlan) and not plan.flights
    return FAILED if plan is None or nothing_flies else DONE
