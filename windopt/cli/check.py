"""``windopt check``: recompute a plan, independently of what made it."""

from json import dumps
from pathlib import Path
from typing import Annotated

import typer

from windopt.checking import Report
from windopt.checking import check as check_plan
from windopt.cli.options import Json
from windopt.cli.terminal import complain, counted, note, say
from windopt.io.plan_consistency import inconsistencies
from windopt.io.plan_reader import plan_from_record
from windopt.io.plans import read_json

PlanFile = Annotated[Path, typer.Argument(metavar="PLAN.json", help="A record that windopt wrote.")]


def check(plan: PlanFile, json: Json = False) -> None:
    """Recompute a plan from its farm, fleet and wind, and list every violation."""
    record = read_json(plan)
    report = check_plan(plan_from_record(record)) + Report(inconsistencies(record))
    if json:
        told = {
            "passed": report.passed,
            "violations": report.violations,
            "warnings": report.warnings,
            "flights": report.flights,
            "set_points": report.set_points,
        }
        typer.echo(dumps(told, indent=2))
    else:
        for sentence in report.violations:
            complain(sentence)
        note(report.warnings)
        faults = counted(len(report.violations), "violation")
        verdict = "passed" if report.passed else f"failed, {faults}"
        recomputed = counted(report.flights, "flight"), counted(report.set_points, "set-point")
        say(f"{plan}: {verdict} ({', '.join(recomputed)}).")
    if not report.passed:
        raise typer.Exit(1)
