"""Tables of points: one a row, in metres or in degrees."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.io.coordinates import to_metres, utm_crs_of
from windopt.io.csv_files import Column, CsvFile

ALIASES = {
    "x": ("x", "easting"),
    "y": ("y", "northing"),
    "lon": ("lon", "longitude"),
    "lat": ("lat", "latitude"),
}

ALIKE = 0.85
"""How much like the name of a column another must be to be taken for a slip."""


@dataclass(frozen=True)
class Positions:
    """Points, and what else the table says about each.

    Parameters
    ----------
    x, y
        Easting and northing [m], shape ``(n,)``.
    crs
        What longitude and latitude were projected to; ``None`` where the table gives metres.
    columns
        The further columns that it holds, by the names they were asked for.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    crs: str | None
    columns: dict[str, Column]


def read_positions(path: str | Path, *, also: Sequence[str], crs: str | None = None) -> Positions:
    """Read columns ``x`` and ``y`` [m], or else ``lon`` and ``lat`` [deg], of a CSV file.

    Parameters
    ----------
    also
        Further columns to read where the table has them; case does not matter.
    crs
        What to project longitude and latitude to; the UTM zone they lie in unless given.

    Raises
    ------
    InvalidInput
        Naming the columns that are missing, or the line and column that cannot be used.
    """
    file = CsvFile.open(path)
    titles = {title.lower(): title for title in reversed(file.head(1)[0])}

    def title(name: str) -> str | None:
        return next((titles[a] for a in ALIASES.get(name, (name,)) if a in titles), None)

    _require_known(titles, [*ALIASES, *also], Path(path).name)
    wanted = {name: t for name in (*ALIASES, *also) if (t := title(name)) is not None}
    if not ({"x", "y"} <= set(wanted) or {"lon", "lat"} <= set(wanted)):
        got = ", ".join(titles.values())
        raise InvalidInput(Path(path).name, "to have columns x and y, or lon and lat", got)
    columns = dict(zip(wanted, file.columns(list(wanted.values())), strict=True))
    further = {name: columns[name] for name in also if name in columns}
    if {"x", "y"} <= set(wanted):
        return Positions(columns["x"].numbers(), columns["y"].numbers(), None, further)
    longitude, latitude = columns["lon"].numbers(), columns["lat"].numbers()
    crs = crs or utm_crs_of(longitude, latitude)
    return Positions(*to_metres(crs, longitude, latitude), crs, further)


def _require_known(titles: Mapping[str, str], known: Sequence[str], file: str) -> None:
    """Refuse a column that nothing reads if it is written much like one that is not there.

    Parameters
    ----------
    titles
        Of the columns, by themselves in lower case.
    """
    missing = [name for name in known if name not in titles]
    read = {*known, *(alias for aliases in ALIASES.values() for alias in aliases)}
    for title in titles.keys() - read:
        if close := get_close_matches(title, missing, n=1, cutoff=ALIKE):
            raise InvalidInput(file, f"column {close[0]}", f"{titles[title]}, which nothing reads")
