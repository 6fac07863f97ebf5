"""How many stations real farms need, by the exact cover and by k-means.

``python -m benchmarks.placements`` places stations for every farm of OptiWindNet with 16 to 210
turbines whose coordinate system is known, and writes the table that the documentation shows.
"""

import argparse
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from time import process_time

from benchmarks.csv_table import tabulate
from windopt.domain.farm import Farm
from windopt.io.optiwindnet import optiwindnet_farm, optiwindnet_sizes
from windopt.planning.station_comparison import k_means_beside, placement
from windopt.planning.station_design import station_design
from windopt.planning.stations import placed_by_cover
from windopt.result import Status

SMALLEST, LARGEST = 16, 210
HEADER = (
    "farm",
    "turbines",
    "stations",
    "bound",
    "k-means",
    "round trips (min)",
    "of k-means, as many stations (min)",
    "processor time (s)",
)


def rows(dwell: float) -> Iterator[tuple[str, ...]]:
    """Yield a row for each farm."""
    for name, size in sorted(optiwindnet_sizes().items()):
        if SMALLEST <= size <= LARGEST and (farm := optiwindnet_farm(name)).crs is not None:
            yield row(farm, dwell)


def row(farm: Farm, dwell: float) -> tuple[str, ...]:
    """Return what the table says of a farm."""
    design = station_design(farm, dwell=dwell)
    begun = process_time()
    result = placed_by_cover(design)
    spent = process_time() - begun
    if result.solution is None:
        return (farm.name, str(len(farm)), str(result.status), *[""] * (len(HEADER) - 3))
    exact = placement("cover", result.solution, design)
    same, *more = k_means_beside(design, len(exact.fleet))
    enough = more[0] if more else same
    proven = result.status is Status.OPTIMAL and not result.reason
    return (
        farm.name,
        str(len(farm)),
        str(len(exact.fleet)),
        f"{result.bound:.0f}",
        str(len(enough.fleet)),
        f"{exact.time / 60:.1f}{'' if proven else ' (not proven)'}",
        f"{same.beyond} beyond reach" if same.beyond else f"{same.time / 60:.1f}",
        f"{spent:.1f}",
    )


def main() -> None:
    """Print the table, and write it."""
    parser = argparse.ArgumentParser(prog="benchmarks.placements", description=__doc__)
    parser.add_argument("--dwell", type=float, default=0.0, help="s")
    parser.add_argument("--out", type=Path, default=Path("docs/how_to/stations.csv"))
    chosen = parser.parse_args()
    tabulate(chain([HEADER], rows(chosen.dwell)), chosen.out)


if __name__ == "__main__":
    main()
