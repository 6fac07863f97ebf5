"""Yaw tables as files, with the column names of FLORIS's ``YawOptimizationSR``.

Angles are in degrees and FLORIS's sign, powers in watts. A CSV file has a row for each wind, its
misalignments as a list in one column, as in FLORIS's table printed by pandas; a netCDF file
(classic format, which needs no further package) has the axes direction, speed and turbine.
"""

import csv
import json
from io import BytesIO, StringIO
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from windopt.domain.yaw_table import YawTable
from windopt.errors import InvalidInput
from windopt.io.whole_files import write_whole

COLUMNS = (
    "wind_direction",
    "wind_speed",
    "turbulence_intensity",
    "yaw_angles_opt",
    "farm_power_opt",
    "farm_power_baseline",
)
DIGITS = 9  # of angles: far below what a nacelle resolves


def require_table_name(path: str | Path) -> None:
    """Raise unless a yaw table can be written under this name."""
    if Path(path).suffix.lower() not in (".csv", ".nc"):
        raise InvalidInput("--out", "to end in .csv or .nc", path)


def write_yaw_table(table: YawTable, path: str | Path, *, force: bool = False) -> Path:
    """Write a yaw table as CSV or netCDF, by the file's ending, whole or not at all.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.

    Raises
    ------
    InvalidInput
        If the ending is another, or the file is there.
    """
    require_table_name(path)
    content = _netcdf(table) if Path(path).suffix.lower() == ".nc" else _csv(table)
    return write_whole(path, content, force=force)


def _csv(table: YawTable) -> str:
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(COLUMNS)
    yaw = np.degrees(table.yaw).round(DIGITS) + 0.0  # no -0.0
    for d, direction in enumerate(np.degrees(table.directions).round(DIGITS).tolist()):
        for v, speed in enumerate(table.speeds.tolist()):
            powers = table.power[d, v], table.power_baseline[d, v]
            angles = json.dumps(yaw[d, v].tolist())
            rows.writerow(
                (direction, speed, table.steering.turbulence, angles, *map(float, powers))
            )
    return text.getvalue()


def _netcdf(table: YawTable) -> bytes:
    buffer = BytesIO()
    file: Any = netcdf_file(buffer, "w")  # attributes are made by setting them
    file.title = f"Yaw table of {table.farm.name}".encode()
    file.turbines = json.dumps(table.farm.names).encode()
    file.turbulence_intensity = table.steering.turbulence
    axes = ("wind_direction", "wind_speed", "turbine")
    for axis, size in zip(axes, table.yaw.shape, strict=True):
        file.createDimension(axis, size)
    for name, values, unit, on in (
        ("wind_direction", np.degrees(table.directions), "degree", axes[:1]),
        ("wind_speed", table.speeds, "m s-1", axes[1:2]),
        ("yaw_angles_opt", np.degrees(table.yaw), "degree", axes),
        ("farm_power_opt", table.power, "W", axes[:2]),
        ("farm_power_baseline", table.power_baseline, "W", axes[:2]),
        ("farm_power_bound", table.bound, "W", axes[:2]),
    ):
        variable = file.createVariable(name, "d", on)
        variable[:] = values
        variable.units = unit.encode()
    file.flush()
    content = buffer.getvalue()
    file.close()
    return content
