"""Certificates of whole farms: how long they are, and how long it takes to make and verify them.

Each farm is planned by the method ``exact`` and its bound proved once more; the certificate is
then verified, times of processors counted. The instances are those of the routing benchmark.
"""

import argparse
from collections.abc import Iterator, Sequence
from itertools import chain, pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.csv_table import tabulate
from benchmarks.inspections import Inspection
from benchmarks.processor import processor_time
from windopt import certify, check
from windopt.io.certificates import write_certificate
from windopt.planning.inspection import plan_inspection

FARMS = "kfB", "anglia", "hornsea2", "borssele", "horns", "london", "thanet", "rampion"
HEADER = "farm, turbines", "K", "plan", "verified", "kB", "plan [s]", "certify [s]", "check [s]"


def measured(farms: Sequence[str], time_limit: float) -> Iterator[tuple[str, ...]]:
    """Yield a row for each farm, in 10 m/s from the east and without dwell."""
    for handle in farms:
        instance = Inspection(handle, 10, 90, 0)
        farm, fleet = instance.farm, instance.fleet
        moments = [processor_time()]
        result = plan_inspection(farm, fleet, instance.wind, method="exact", time_limit=time_limit)
        moments.append(processor_time())
        certificate = certify(result, time_limit=time_limit)
        moments.append(processor_time())
        report = check(result, certificate)
        moments.append(processor_time())
        with TemporaryDirectory() as folder:
            size = write_certificate(certificate, Path(folder) / "c.json").stat().st_size
        times = [f"{end - begin:.1f}" for begin, end in pairwise(moments)]
        plan = f"{result.objective:.2f} s, {result.status}"
        verified = "not feasible" if report.unverified else f"{certificate.proof.bound:.2f} s"
        row = f"{farm.name}, {len(farm)}", str(len(fleet)), plan, verified, f"{size / 1e3:.0f}"
        yield *row, *times


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table, and write it."""
    parser = argparse.ArgumentParser(description="Size of certificates, and time to verify them.")
    parser.add_argument("--farms", nargs="+", default=FARMS)
    parser.add_argument("--time-limit", type=float, default=120.0)
    parser.add_argument("--out", type=Path, help="a CSV file for the table, beside printing it")
    chosen = parser.parse_args(arguments)
    tabulate(chain([HEADER], measured(chosen.farms, chosen.time_limit)), chosen.out)


if __name__ == "__main__":
    main()
