"""Routing methods on real farms: ``python -m benchmarks run routing [FARM:STATIONS ...]``.

Every method plans every instance under one time limit and one wind; stations are placed by
k-means, so that a name and a number say which instance it is. Each answer has passed
:mod:`windopt.checking`; a failure becomes a row of its own.
"""

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmarks.records import machine, write_lines
from windopt.domain.farm import Farm
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection
from windopt.planning.routing_methods import METHODS
from windopt.planning.stations import stations_by_k_means

INSTANCES = ("Albatros:1", "Albatros:2", "Ormonde:1", "Kriegers Flak B:4", "Hornsea 2:10")


def measured(
    instances: Sequence[str],
    methods: Sequence[str],
    *,
    wind: Wind,
    dwell: float,
    time_limit: float,
    seed: int,
) -> Iterator[dict[str, Any]]:
    """Yield a record for each method on each instance, ``FARM:STATIONS``."""
    for instance in instances:
        name, _, count = instance.rpartition(":")
        farm = Farm.load(name)
        fleet = stations_by_k_means(farm, int(count), dwell=dwell, seed=seed)
        for method in methods:
            case = {"farm": name, "turbines": len(farm), "stations": len(fleet), "method": method}
            try:
                result = plan_inspection(
                    farm, fleet, wind, method=method, dwell=dwell, time_limit=time_limit, seed=seed
                )
            except Exception as failure:
                yield case | {"status": "failed", "reason": str(failure)}
                continue
            yield case | {
                "status": str(result.status),
                "objective": result.objective,
                "bound": result.bound,
                "gap": result.gap,
                "runtime": result.runtime,
                "reason": result.reason,
                "unreachable": len(result.found().unreachable),
            }


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark and write a line for each answer."""
    parser = argparse.ArgumentParser(prog="benchmarks run routing", description=__doc__)
    parser.add_argument("instances", nargs="*", metavar="FARM:STATIONS", default=INSTANCES)
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    parser.add_argument("--wind-speed", type=float, default=10.0, help="m/s")
    parser.add_argument("--wind-direction", type=float, default=90.0, help="deg, from")
    parser.add_argument("--dwell", type=float, default=0.0, help="s")
    parser.add_argument("--time-limit", type=float, default=60.0, help="s")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path("routing.jsonl"), help="JSON lines")
    chosen = parser.parse_args(arguments)
    records = measured(
        chosen.instances or INSTANCES,
        chosen.methods,
        wind=Wind.from_met(chosen.wind_speed, chosen.wind_direction),
        dwell=chosen.dwell,
        time_limit=chosen.time_limit,
        seed=chosen.seed,
    )
    setting = {name: value for name, value in vars(chosen).items() if isinstance(value, float)}
    write_lines((record | setting | machine() for record in records), chosen.out)
