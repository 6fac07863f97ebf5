"""Farms as tables: one turbine a row."""

from pathlib import Path

from windopt.domain.farm import Farm
from windopt.domain.turbine import Turbine
from windopt.io.coordinates import projected_crs
from windopt.io.positions import Positions, read_positions
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import types_by_rating

CRS_NOTE = "The column crs is for metres and is not used; longitude and latitude became {}."


def farm_from_csv(path: str | Path) -> Farm:
    """Read a farm from a CSV file.

    Parameters
    ----------
    path
        Columns ``x`` and ``y`` [m], or ``lon`` and ``lat`` [deg], which are projected to the UTM
        zone they lie in. Where wanted also ``name`` (numbered without it), ``rated_power_mw`` (an
        SG 8.0-167 DD without it) and, for metres, ``crs``, the same in each row.

    Raises
    ------
    InvalidInput
        Naming the column and the line that cannot be used.
    """
    path = Path(path)
    table = read_positions(path, also=("name", "rated_power_mw", "crs"))
    n = len(table.x)
    names, name_notes = distinct_names([None] * n)
    if "name" in table.columns:
        names, name_notes = table.columns["name"].names(), ()
    ratings: list[float | None] = [None] * n
    if "rated_power_mw" in table.columns:
        ratings = (1e6 * table.columns["rated_power_mw"].positive("MW")).tolist()
    types, type_notes = types_by_rating(ratings)
    crs = table.crs or _crs(table)
    crs_notes = (CRS_NOTE.format(crs),) if table.crs and "crs" in table.columns else ()
    return Farm(
        path.stem,
        tuple(map(Turbine, names, table.x.tolist(), table.y.tolist(), types)),
        crs=crs,
        source=str(path),
        notes=(*name_notes, *type_notes, *crs_notes),
    )


def _crs(table: Positions) -> str | None:
    """Return the one CRS that the rows give, if any does."""
    if "crs" not in table.columns:
        return None
    column = table.columns["crs"]
    given = next(filter(None, column.cells), "")
    for row, cell in enumerate(column.cells):
        if cell not in ("", given):
            raise column.refuse(row, f"to be the same in each row, {given!r}")
    return projected_crs(given) if given else None
