"""``windopt check``: recompute a plan, and its proof, independently of what made them."""

from json import dumps
from pathlib import Path
from typing import Annotated

import typer

from windopt.checking import Report
from windopt.checking import check as check_plan
from windopt.cli.options import Json
from windopt.cli.outcome import DONE, FAILED, UNVERIFIED
from windopt.cli.terminal import complain, counted, note, progress, say
from windopt.io.certificates import read_certificate
from windopt.io.plan_consistency import inconsistencies
from windopt.io.plan_reader import plan_from_record
from windopt.io.plans import read_json

CertificateFile = Annotated[
    Path | None, typer.Option(metavar="FILE", help="A certificate of the bound, to verify too.")
]
PlanFile = Annotated[Path, typer.Argument(metavar="PLAN.json", help="A record that windopt wrote.")]


def check(plan: PlanFile, certificate: CertificateFile = None, json: Json = False) -> None:
    """Recompute a plan from its farm, fleet and wind, and list every violation."""
    record = read_json(plan)
    proof = None if certificate is None else read_certificate(certificate)
    with progress(f"Checking {plan}"):
        report = check_plan(plan_from_record(record), proof) + Report(inconsistencies(record))
    if json:
        told = {
            "passed": report.passed,
            "violations": report.violations,
            "warnings": report.warnings,
            "flights": report.flights,
            "set_points": report.set_points,
            "unverified": report.unverified,
            "proved": report.proved,
        }
        typer.echo(dumps(told, indent=2))
    else:
        for sentence in report.violations + report.unverified:
            complain(sentence)
        note(report.warnings)
        for sentence in report.proved:
            say(sentence)
        recomputed = counted(report.flights, "flight"), counted(report.set_points, "set-point")
        say(f"{plan}: {_verdict(report)} ({', '.join(recomputed)}).")
    raise typer.Exit(FAILED if report.violations else UNVERIFIED if report.unverified else DONE)


def _verdict(report: Report) -> str:
    if report.violations:
        return f"failed, {counted(len(report.violations), 'violation')}"
    return "passed" if report.passed else "no violation, but the proof could not be verified"
