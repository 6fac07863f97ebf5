"""Stations as tables: one a row, in the file format of the command line's ``--stations``."""

import csv
from dataclasses import replace
from io import StringIO
from pathlib import Path

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Station, Uav
from windopt.errors import InvalidInput
from windopt.io.positions import Positions, read_positions
from windopt.io.whole_files import write_whole

LIMITS = {"airspeed": "m/s", "t_max": "s", "wind_max": "m/s"}


def read_stations(path: str | Path, farm: Farm | None = None, *, uav: Uav = FALCON_8) -> Fleet:
    """Read the stations of a fleet from a CSV file.

    Parameters
    ----------
    path
        Columns ``id``, and ``x`` and ``y`` [m] in the farm's CRS or ``lon`` and ``lat`` [deg];
        where wanted also ``airspeed`` [m/s], ``t_max`` [s] and ``wind_max`` [m/s], whose empty
        cells leave ``uav`` as it is, and ``max_flights``, whose empty cells allow any number.
    farm
        Whose CRS longitude and latitude are projected to.
    uav
        What is kept at each station.

    Raises
    ------
    InvalidInput
        Naming the column and the line that cannot be used.
    """
    crs = farm.crs if farm is not None else None
    table = read_positions(path, also=("id", *LIMITS, "max_flights"), crs=crs)
    if table.crs is not None and crs is None:
        raise InvalidInput("stations", "in metres, as the farm has no known CRS", "lon and lat")
    if "id" not in table.columns:
        raise InvalidInput(Path(path).name, "to have a column id", "none")
    limits = {
        name: table.columns[name].positive(unit, missing=True).tolist()
        for name, unit in LIMITS.items()
        if name in table.columns
    }
    most = _most_flights(table)
    stations = []
    for i, name in enumerate(table.columns["id"].names()):
        own = {limit: values[i] for limit, values in limits.items() if values[i] == values[i]}
        station = Station(name, float(table.x[i]), float(table.y[i]), replace(uav, **own), most[i])
        stations.append(station)
    return Fleet(tuple(stations))


def _most_flights(table: Positions) -> list[int | None]:
    """Return the most flights of each station, ``None`` for any number."""
    if "max_flights" not in table.columns:
        return [None] * len(table.x)
    column = table.columns["max_flights"]
    numbers = column.numbers(missing=True)
    for row, number in enumerate(numbers):
        if number < 0 or number % 1 > 0:
            raise column.refuse(row, "to be a whole number >= 0")
    return [None if np.isnan(number) else int(number) for number in numbers]


def write_stations(fleet: Fleet, path: str | Path, *, force: bool = False) -> Path:
    """Write the stations of a fleet as a table that :func:`read_stations` reads back.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.
    """
    text = StringIO(newline="")
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("id", "x", "y", *LIMITS, *(["max_flights"] if fleet.limited else [])))
    for station in fleet.stations:
        limits = (getattr(station.uav, limit) for limit in LIMITS)
        most = [station.max_flights] if fleet.limited else []
        rows.writerow((station.name, station.x, station.y, *limits, *most))
    return write_whole(path, text.getvalue(), force=force)
