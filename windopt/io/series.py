"""Wind series from tables: any CSV with time, speed and direction, the WIND Toolkit's among them.

What cannot be true is masked rather than kept or guessed: the series comes back on one regular
clock, with NaN wherever nothing valid was measured, and its notes count every such step.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windopt.domain.wind import Times, WindSeries
from windopt.errors import InvalidInput
from windopt.io.csv_files import Column, CsvFile
from windopt.io.regular_steps import in_order, regular_steps
from windopt.io.time_stamps import parse_times, times_of_parts
from windopt.io.wind_columns import wind_columns

Floats = NDArray[np.float64]
Notes = tuple[str, ...]

MIN_ROWS = 4  # fewer cannot tell a step from a gap
MAX_SPEED = 100.0  # m/s; no mean wind at a rotor's height has reached it


def read_series(
    path: str | Path, *, time: str = "", speed: str = "", direction: str = ""
) -> WindSeries:
    """Read a wind series from a CSV file; see :meth:`windopt.WindSeries.read`.

    Speeds are in m/s and directions in degrees. Time stamps with an offset are brought to UTC;
    others stay on their own clock. Rows must follow each other in time, one way or the other, and
    are laid on the grid of their most common step.
    """
    file = CsvFile.open(path)
    found = wind_columns(file, time=time, speed=speed, direction=direction)
    names = [*found.time, found.speed, found.direction]
    *stamps, speeds, directions = file.columns(names, found.header)
    if len(speeds.cells) < MIN_ROWS:
        raise InvalidInput(file.path.name, f"of at least {MIN_ROWS} rows", len(speeds.cells))

    site = _preamble(file, found.header)
    times, timezone, clock_notes = _clock(stamps, site)
    v, speed_notes = _masked(speeds, 0.0, MAX_SPEED)
    theta, direction_notes = _masked(directions, -360.0, 720.0)
    missing = int(np.count_nonzero(np.isnan(v) | np.isnan(theta)))
    if missing == len(v):
        raise InvalidInput("speed and direction", "to be known in some row", "none")
    order = slice(None, None, 1 if in_order(times, np.array(speeds.lines)) else -1)
    grid, place, grid_notes = regular_steps(times[order])

    speed_series, theta_series = np.full((2, len(grid)), np.nan)
    speed_series[place] = v[order]
    theta_series[place] = np.radians(theta[order] % 360.0)
    notes = [*clock_notes, *speed_notes, *direction_notes, *grid_notes]
    if order.step < 0:
        notes.append("The rows run backwards in time and were turned round.")
    if missing:
        notes.append(f"Rows without a valid speed or direction: {missing} of {len(v)}.")
    facts = ", ".join(f"{key} {value}" for key, value in site.items())
    source = f"{file.path.name} ({facts})" if facts else file.path.name
    return WindSeries(grid, speed_series, theta_series, timezone, source, tuple(notes))


def _preamble(file: CsvFile, header: int) -> dict[str, str]:
    """Return what the rows above the header say about the site, as pairs of cells."""
    pairs = (pair for row in file.head(header) for pair in zip(row[::2], row[1::2], strict=False))
    return {key: value for key, value in pairs if key and value}


def _clock(stamps: list[Column], site: dict[str, str]) -> tuple[Times, str, Notes]:
    """Return the times, their zone, and a note if they name none."""
    times, timezone = parse_times(stamps[0]) if len(stamps) == 1 else (times_of_parts(stamps), "")
    if not timezone and site.get("Data Timezone") in ("0", "0.0"):  # as the WIND Toolkit's API says
        timezone = "UTC"
    note = "The time stamps name no time zone and are kept on their own clock."
    return times, timezone, () if timezone else (note,)


def _masked(column: Column, low: float, high: float) -> tuple[Floats, Notes]:
    """Return a column's numbers, NaN outside ``[low, high]``, and a note that counts these."""
    numbers = column.numbers(missing=True)
    beyond = (numbers < low) | (numbers > high)
    count = int(np.count_nonzero(beyond))
    note = f"Values of {column.name!r} beyond {low:g} to {high:g}, masked: {count}."
    return np.where(beyond, np.nan, numbers), (note,) if count else ()
