"""Time stamps: texts in, NumPy times on one clock out.

Stamps that carry an offset, UTC or GMT are brought to UTC; others stay on their own clock,
whatever it is.
"""

from collections.abc import Sequence
from datetime import UTC, datetime

import numpy as np

from windopt.domain.wind import Times
from windopt.io.csv_files import Column

FORMAT = "to be an ISO 8601 time such as 2011-04-13T22:00"


def parse_times(column: Column) -> tuple[Times, str]:
    """Return the times of a column and their time zone.

    Returns
    -------
    Times
        In seconds, or in microseconds where some stamp has a fraction of one.
    str
        ``"UTC"`` if the stamps or the column's name say so, empty otherwise.

    Raises
    ------
    InvalidInput
        Naming the line of the first stamp that is none, or has an offset while others have none.
    """
    stamps: list[datetime] = []
    for row, cell in enumerate(column.cells):
        try:
            stamps.append(_stamp(cell))
        except ValueError:
            raise column.refuse(row, FORMAT) from None
    aware = [stamp.tzinfo is not None for stamp in stamps]
    if any(aware):
        if not all(aware):
            odd = aware.index(not aware[0])
            raise column.refuse(odd, "to have an offset like the others, or none")
        stamps = [stamp.astimezone(UTC).replace(tzinfo=None) for stamp in stamps]
    utc = any(aware) or "utc" in column.name.lower()
    times = np.array(stamps, dtype="datetime64[us]")
    whole = times.astype("datetime64[s]")
    return whole if (whole == times).all() else times, "UTC" if utc else ""


def _stamp(text: str) -> datetime:
    bare = text.removesuffix("UTC").removesuffix("GMT")
    if bare == text:
        return datetime.fromisoformat(text)
    return datetime.fromisoformat(f"{bare.rstrip()}+00:00")


def times_of_parts(parts: Sequence[Column]) -> Times:
    """Return the times given by columns of years, months, days, hours and minutes.

    Raises
    ------
    InvalidInput
        Naming the line of the first row that is no time.
    """
    year, month, day, hour, minute = (column.numbers() for column in parts)
    whole = [part.astype("int64") for part in (year, month, day, hour, minute)]
    limits = ((1, 9999), (1, 12), (1, 31), (0, 23), (0, 59))
    for column, part, (low, high) in zip(parts, whole, limits, strict=True):
        bad = (part < low) | (part > high)
        if bad.any():
            raise column.refuse(int(bad.argmax()), f"from {low} to {high}")
    y, m, d, h, minutes = whole
    months = (y - 1970) * 12 + m - 1
    days = months.astype("datetime64[M]").astype("datetime64[D]") + (d - 1)
    late = days.astype("datetime64[M]").astype("int64") != months
    if late.any():
        raise parts[2].refuse(int(late.argmax()), "to be a day of its month")
    times: Times = days.astype("datetime64[s]") + (h * 3600 + minutes * 60)
    return times
