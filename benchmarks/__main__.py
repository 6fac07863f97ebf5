"""Measure methods on instances, and make tables, pictures and pages of what was measured."""

import argparse
import os
import shlex
import sys
from fnmatch import fnmatch
from pathlib import Path

from joblib import cpu_count

from benchmarks.case import Case
from benchmarks.processor import EACH
from benchmarks.records import read_lines
from benchmarks.registry import PROBLEMS, SETS, problem
from benchmarks.runner import run
from windopt.errors import MissingExtra

MEASURED = Path("measured")
"""Where lines go unless told otherwise."""
RESULTS = Path("benchmarks/results")
"""The lines behind the published pages."""
PAGES = Path("docs/benchmarks/generated")


def main(words: list[str] | None = None) -> None:
    """Run a benchmark, or report what was measured."""
    chosen = _parser().parse_args(words)
    try:
        chosen.command(chosen)
    except MissingExtra as lacking:
        sys.exit(str(lacking))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    commands = parser.add_subparsers(required=True)
    cores = cpu_count(only_physical_cores=True)
    running = commands.add_parser("run", help="measure; a line of JSON for each case")
    add = running.add_argument
    add("problem", nargs="?", default="all", choices=(*PROBLEMS, "all"))
    add("--set", default="small", choices=SETS, help="of instances (default: %(default)s)")
    add("--instance", nargs="+", default=["*"], metavar="PATTERN", help="only these")
    add("--method", nargs="+", metavar="NAME", help="only these; or module:function")
    add("--time-limit", type=float, help="of each case [s]; each set has its own")
    add("--seed", type=int, nargs="+", default=[0])
    add("--jobs", type=int, default=cores, help="cases at a time here (default: one a core)")
    add("--processors", type=int, default=1, help="for each case here (default: %(default)s)")
    add("--scheduler", default="", metavar="ADDRESS", help="of a dask cluster to run on instead")
    add("--resume", action="store_true", help="go on where an earlier run ended")
    add("--out", type=Path, default=MEASURED, help="folder of lines (default: %(default)s)")
    running.set_defaults(command=_run)
    reporting = commands.add_parser("report", help="make tables, pictures and pages of lines")
    reporting.add_argument("--lines", type=Path, help=f"their folder ({MEASURED}, or {RESULTS})")
    reporting.add_argument("--out", type=Path, default=PAGES, help="default: %(default)s")
    reporting.set_defaults(command=_report)
    exporting = commands.add_parser("export", help="write routing instances in VRPLIB form")
    exporting.add_argument("--set", default="small", choices=SETS)
    exporting.add_argument("--instance", nargs="+", default=["*"], metavar="PATTERN")
    exporting.add_argument("--lines", type=Path, default=RESULTS, help="with the best plans known")
    exporting.add_argument("--out", type=Path, required=True)
    exporting.set_defaults(command=_export)
    return parser


def _export(chosen: argparse.Namespace) -> None:
    from benchmarks.vrplib_files import export

    lines = chosen.lines / "routing.jsonl"
    written = export(_chosen("routing", chosen), read_lines(lines), chosen.out)
    print(f"{len(written)} instances in {chosen.out}")


def _report(chosen: argparse.Namespace) -> None:
    from benchmarks.report.pages import write_pages

    lines = chosen.lines or (MEASURED if MEASURED.exists() else RESULTS)
    for page in write_pages(lines, chosen.out):
        print(page)


def _run(chosen: argparse.Namespace) -> None:
    command = shlex.join(["python", "-m", "benchmarks", *_without_folder(sys.argv[1:])])
    os.environ[EACH] = str(chosen.processors)
    for name in PROBLEMS if chosen.problem == "all" else [chosen.problem]:
        lines = chosen.out / f"{name}.jsonl"
        if lines.exists() and not chosen.resume:
            sys.exit(f"{lines} exists: add --resume to go on, or name another folder by --out.")
        cases = _cases(name, chosen)
        if not cases:
            print(f"{name}: nothing in the set {chosen.set}")
            continue
        found = run(cases, lines, jobs=chosen.jobs, scheduler=chosen.scheduler, command=command)
        if shown := problem(name).show(found):
            print(shown, end="\n\n")
        failed = sum(record["status"] == "failed" for record in found)
        print(f"{lines}: {len(found)} cases, {failed} failed")


def _without_folder(words: list[str]) -> list[str]:
    """Return a command without where its lines go, which tells of one machine only."""
    left = iter(words)
    kept = []
    for word in left:
        if word == "--out":
            next(left, None)
        elif not word.startswith("--out="):
            kept.append(word)
    return kept


def _chosen(name: str, chosen: argparse.Namespace) -> list[str]:
    """Return the instances of the set that a pattern fits, and others that are named in full."""
    every = problem(name).instances(chosen.set)
    fitting = [one for one in every if any(fnmatch(one, pattern) for pattern in chosen.instance)]
    others = [one for one in chosen.instance if one not in every and not set(one) & set("*?[")]
    return [*fitting, *others]


def _cases(name: str, chosen: argparse.Namespace) -> list[Case]:
    kind = problem(name)
    if chosen.set not in kind.time_limits:
        return []
    limit = chosen.time_limit or kind.time_limits[chosen.set]
    methods = chosen.method or kind.methods(chosen.set)
    return [
        Case(name, instance, method, limit, seed)
        for instance in _chosen(name, chosen)
        for method in methods
        for seed in chosen.seed
    ]


if __name__ == "__main__":
    main()
