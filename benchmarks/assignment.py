"""What it costs to bind each turbine to its nearest station: ``python -m benchmarks.assignment``.

The paper assigns turbines to UAVs once and plans the flights of each; the joint problem chooses
both. Each instance is solved both ways by the exact method, and both plans are checked.
"""

import argparse
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path

from benchmarks.csv_table import tabulate
from windopt.domain.farm import Farm
from windopt.domain.plan import InspectionPlan
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection
from windopt.planning.stations import stations_by_k_means
from windopt.result import Result

INSTANCES = (
    "Kriegers Flak B:4",
    "Horns Rev 1:4",
    "East Anglia ONE:6",
    "Hornsea 2:10",
    "Borssele:10",
    "London Array:4",
)
HEADER = ("farm", "turbines", "stations", "nearest station (s)", "any station (s)", "dearer by")


def rows(instances: Sequence[str], wind: Wind, time_limit: float) -> Iterator[list[str]]:
    """Yield a row for each instance, ``FARM:STATIONS``."""
    for instance in instances:
        name, _, count = instance.rpartition(":")
        farm = Farm.load(name)
        fleet = stations_by_k_means(farm, int(count))
        bound_to, joint = (
            plan_inspection(
                farm, fleet, wind, method="exact", assignment=assignment, time_limit=time_limit
            )
            for assignment in ("nearest", None)
        )
        dearer = bound_to.objective / joint.objective - 1.0
        times = told(bound_to), told(joint)
        yield [name, str(len(farm)), count, *times, f"{dearer:.2%}"]


def told(result: Result[InspectionPlan]) -> str:
    """Return time and, where it is not proved least, the gap; and who is out of reach."""
    proof = "" if result.gap < 1e-6 else f", gap {result.gap:.2%}"
    lacking = len(result.found().unreachable)
    return f"{result.objective:.1f}{proof}" + (f", {lacking} out of reach" if lacking else "")


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table, and write it."""
    parser = argparse.ArgumentParser(prog="benchmarks.assignment", description=__doc__)
    parser.add_argument("instances", nargs="*", metavar="FARM:STATIONS")
    parser.add_argument("--wind-speed", type=float, default=10.0, help="m/s")
    parser.add_argument("--wind-direction", type=float, default=90.0, help="deg, from")
    parser.add_argument("--time-limit", type=float, default=120.0, help="s")
    parser.add_argument("--out", type=Path, help="a CSV file")
    chosen = parser.parse_args(arguments)
    wind = Wind.from_met(chosen.wind_speed, chosen.wind_direction)
    found = rows(chosen.instances or INSTANCES, wind, chosen.time_limit)
    tabulate(chain([HEADER], found), chosen.out)


if __name__ == "__main__":
    main()
