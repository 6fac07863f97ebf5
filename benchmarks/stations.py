"""The stations of each farm: the fewest that reach every turbine, by the exact cover.

They are part of an instance and shall not change with a solver's version, so they are kept in
``stations.csv``, which ``python -m benchmarks.stations`` completes. A dwell shortens the reach, so
there is a placement for each.
"""

import csv
from collections.abc import Iterator
from functools import cache
from itertools import groupby
from pathlib import Path

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.planning.stations import stations_by_cover

TABLE = Path(__file__).with_name("stations.csv")
FIELDS = "farm", "dwell", "x", "y"
TIME_LIMIT = 60.0
"""Of a placement [s]."""


def stations(handle: str, farm: Farm, dwell: int) -> Fleet:
    """Return the stations of a farm for a dwell [s], placed anew if they are not in the table."""
    placed = _table().get((handle, dwell))
    return placed or _placed(farm, dwell)


def _placed(farm: Farm, dwell: int) -> Fleet:
    return stations_by_cover(farm, dwell=float(dwell), time_limit=TIME_LIMIT).found()


@cache
def _table() -> dict[tuple[str, int], Fleet]:
    """Return the placements that are kept."""
    with TABLE.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    groups = groupby(rows, key=lambda row: (row["farm"], int(row["dwell"])))
    return {key: Fleet(tuple(_stations(list(group)))) for key, group in groups}


def _stations(rows: list[dict[str, str]]) -> Iterator[Station]:
    for number, row in enumerate(rows, 1):
        yield Station(f"S{number}", float(row["x"]), float(row["y"]))


def main() -> None:
    """Add the placements that the sets of the routing benchmark need and the table has not."""
    from benchmarks.inspections import Inspection
    from benchmarks.routing import SETS, instances

    known = set(_table())
    named = (Inspection.named(name) for chosen in SETS for name in instances(chosen))
    for inspection in named:
        key = inspection.handle, inspection.dwell
        if key in known:
            continue
        known.add(key)
        fleet = _placed(inspection.farm, inspection.dwell)
        with TABLE.open("a", newline="", encoding="utf-8") as file:
            rows = ((*key, f"{s.x:.2f}", f"{s.y:.2f}") for s in fleet.stations)
            csv.writer(file, lineterminator="\n").writerows(rows)


if __name__ == "__main__":
    main()
