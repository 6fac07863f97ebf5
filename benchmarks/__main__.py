"""``python -m benchmarks run NAME ...`` measures; ``python -m benchmarks report`` makes a table."""

import argparse
from importlib import import_module
from pathlib import Path

from benchmarks.records import read_lines, routing_table, write_table

BENCHMARKS = {
    "routing": "benchmarks.routing",
    "forecast": "benchmarks.forecast",
    "edge": "benchmarks.edge",
}


def main() -> None:
    """Run a benchmark, or report one."""
    parser = argparse.ArgumentParser(prog="benchmarks", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="measure; options after the name are the benchmark's")
    run.add_argument("name", choices=BENCHMARKS)
    run.add_argument("options", nargs=argparse.REMAINDER)
    report = commands.add_parser("report", help="make a table of what was measured")
    report.add_argument("lines", type=Path, help="JSON lines of the routing benchmark")
    report.add_argument("--out", type=Path, required=True, help="a CSV file")
    chosen = parser.parse_args()
    if chosen.command == "run":
        import_module(BENCHMARKS[chosen.name]).main(chosen.options)
    else:
        write_table(routing_table(read_lines(chosen.lines)), chosen.out)


if __name__ == "__main__":
    main()
