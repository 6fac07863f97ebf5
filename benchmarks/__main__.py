"""Measure methods on instances, and make tables, pictures and pages of what was measured."""

import argparse
import shlex
import sys
from fnmatch import fnmatch
from importlib import import_module
from pathlib import Path

from benchmarks.case import Case
from benchmarks.registry import PROBLEMS, SETS, TABLES, problem
from benchmarks.runner import run

MEASURED = Path("measured")
"""Where lines go unless told otherwise."""
RESULTS = Path("benchmarks/results")
"""The lines behind the published pages."""
PAGES = Path("docs/benchmarks/generated")


def main(words: list[str] | None = None) -> None:
    """Run a benchmark, or report what was measured."""
    words = sys.argv[1:] if words is None else words
    if words[:1] == ["run"] and set(words[1:2]) & set(TABLES):
        import_module(TABLES[words[1]]).main(words[2:])
        return
    chosen = _parser().parse_args(words)
    chosen.command(chosen)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    commands = parser.add_subparsers(required=True)
    running = commands.add_parser("run", help="measure; a line of JSON for each case")
    add = running.add_argument
    tables = f"or {' or '.join(TABLES)}, which have options of their own"
    add("problem", nargs="?", default="all", choices=(*PROBLEMS, "all"), help=tables)
    add("--set", default="small", choices=SETS, help="of instances (default: %(default)s)")
    add("--instance", nargs="+", default=["*"], metavar="PATTERN", help="only these of the set")
    add("--method", nargs="+", metavar="NAME", help="only these; or module:function")
    add("--time-limit", type=float, help="of each case [s]; each set has its own")
    add("--seed", type=int, nargs="+", default=[0])
    add("--jobs", type=int, default=1, help="cases at a time on this machine")
    add("--scheduler", default="", metavar="ADDRESS", help="of a dask cluster to run on instead")
    add("--resume", action="store_true", help="go on where an earlier run ended")
    add("--out", type=Path, default=MEASURED, help="folder of lines (default: %(default)s)")
    running.set_defaults(command=_run)
    reporting = commands.add_parser("report", help="make tables, pictures and pages of lines")
    reporting.add_argument("--lines", type=Path, help=f"their folder ({MEASURED}, or {RESULTS})")
    reporting.add_argument("--out", type=Path, default=PAGES, help="default: %(default)s")
    reporting.set_defaults(command=_report)
    return parser


def _report(chosen: argparse.Namespace) -> None:
    from benchmarks.report.pages import write_pages

    lines = chosen.lines or (MEASURED if MEASURED.exists() else RESULTS)
    for page in write_pages(lines, chosen.out):
        print(page)


def _run(chosen: argparse.Namespace) -> None:
    command = shlex.join(["python", "-m", "benchmarks", *sys.argv[1:]])
    for name in PROBLEMS if chosen.problem == "all" else [chosen.problem]:
        lines = chosen.out / f"{name}.jsonl"
        if lines.exists() and not chosen.resume:
            sys.exit(f"{lines} exists: add --resume to go on, or name another folder by --out.")
        cases = list(_cases(name, chosen))
        found = run(cases, lines, jobs=chosen.jobs, scheduler=chosen.scheduler, command=command)
        failed = sum(record["status"] == "failed" for record in found)
        print(f"{lines}: {len(found)} cases, {failed} failed")


def _cases(name: str, chosen: argparse.Namespace) -> list[Case]:
    kind = problem(name)
    limit = chosen.time_limit or kind.time_limits[chosen.set]
    methods = chosen.method or kind.methods(chosen.set)
    return [
        Case(name, instance, method, limit, seed)
        for instance in kind.instances(chosen.set)
        if any(fnmatch(instance, pattern) for pattern in chosen.instance)
        for method in methods
        for seed in chosen.seed
    ]


if __name__ == "__main__":
    main()
