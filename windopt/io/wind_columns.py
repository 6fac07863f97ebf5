"""Which columns of a file hold time, speed and direction, by their usual names."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from windopt.errors import InvalidInput
from windopt.io.csv_files import CsvFile

PARTS = ("year", "month", "day", "hour", "minute")
AFTER = r"([ _-]*(at)?[ _-]*\d+ ?m?)?([ _-]*(mean|avg|average))?([ _-]*(m/s|mps|ms|deg))?"
NAMES = {
    "time": re.compile(
        r"(time|date|utc|time[ _-]?stamp|date[ _/-]?time)([ _-](utc|gmt|local|start|stamp))?", re.I
    ),
    "speed": re.compile(rf"(wind[ _-]?(speed|spd)|wspd|ws|speed|ff){AFTER}", re.I),
    "direction": re.compile(rf"(wind[ _-]?dir(ection)?|wdir|wd|dir(ection)?|dd){AFTER}", re.I),
}
BRACKETS = re.compile(r"\s*[(\[](.*?)[)\]]\s*")
OTHER_UNITS = {
    "speed": re.compile(r"km/?h|kph|kn|kts?|knots?|mph|ft/s", re.I),
    "direction": re.compile(r"rad(ians?)?|gon", re.I),
}


@dataclass(frozen=True)
class WindColumns:
    """Where a file keeps its wind.

    Parameters
    ----------
    header
        The row that names the columns, from 0.
    time
        The column of time stamps, or those of year, month, day, hour and minute.
    speed, direction
        The columns of speed [m/s] and direction [deg].
    """

    header: int
    time: tuple[str, ...]
    speed: str
    direction: str


def wind_columns(
    file: CsvFile, *, time: str = "", speed: str = "", direction: str = ""
) -> WindColumns:
    """Find the columns of a file, whose header is one of its first four rows.

    Parameters
    ----------
    time, speed, direction
        Names of the columns; those left out are recognised by usual names.

    Raises
    ------
    InvalidInput
        Naming what is missing or fits several columns, and listing the columns.
    """
    rows = file.head(4)
    header = max(range(len(rows)), key=lambda i: (_fitness(rows[i], (time, speed, direction)), -i))
    titles = rows[header]
    parts = _parts(titles)
    return WindColumns(
        header,
        parts if parts and not time else (_column(titles, "time", time),),
        _column(titles, "speed", speed),
        _column(titles, "direction", direction),
    )


def _bare(title: str) -> str:
    return BRACKETS.sub("", title)


def _fitness(titles: Sequence[str], given: Sequence[str]) -> int:
    """Count how many of time, speed and direction a row names."""
    named = [
        any(title == name or pattern.fullmatch(_bare(title)) for title in titles)
        for pattern, name in zip(NAMES.values(), given, strict=True)
    ]
    return sum(named) + bool(_parts(titles))


def _parts(titles: Sequence[str]) -> tuple[str, ...]:
    """Return the columns of the parts of a time; empty unless all are there."""
    known = {title.lower(): title for title in titles}
    return tuple(known[part] for part in PARTS) if set(PARTS) <= set(known) else ()


def _column(titles: Sequence[str], role: str, given: str) -> str:
    listed = f"the columns {', '.join(titles)}"
    fits = [t for t in titles if (t == given if given else NAMES[role].fullmatch(_bare(t)))]
    if not fits:
        raise InvalidInput(f"a column {given or f'of {role}'}", "in the file", listed)
    if len(fits) > 1:
        expected = f"to be chosen from {', '.join(fits)}, which all fit"
        raise InvalidInput(f"the {role} column", expected, listed)
    unit = BRACKETS.search(fits[0])
    if role in OTHER_UNITS and unit and OTHER_UNITS[role].fullmatch(unit[1].strip()):
        raise InvalidInput(f"the {role} column", "in m/s" if role == "speed" else "in deg", unit[1])
    return fits[0]
