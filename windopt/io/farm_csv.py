"""Farms as tables: one turbine a row."""

from pathlib import Path

from windopt.domain.farm import Farm
from windopt.domain.turbine import Turbine
from windopt.errors import InvalidInput
from windopt.io.coordinates import projected_crs
from windopt.io.positions import Positions, read_positions
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import types_by_rating


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
        names, name_notes = list(table.columns["name"].cells), ()
    ratings: list[float | None] = [None] * n
    if "rated_power_mw" in table.columns:
        ratings = [1e6 * power for power in table.columns["rated_power_mw"].numbers().tolist()]
    types, type_notes = types_by_rating(ratings)
    return Farm(
        path.stem,
        tuple(map(Turbine, names, table.x.tolist(), table.y.tolist(), types)),
        crs=table.crs or _crs(table),
        source=str(path),
        notes=(*name_notes, *type_notes),
    )


def _crs(table: Positions) -> str | None:
    """Return the one CRS that the rows give, if any does."""
    given = sorted(set(table.columns["crs"].cells) - {""}) if "crs" in table.columns else []
    if len(given) > 1:
        raise InvalidInput("crs", "to be the same in each row", ", ".join(given[:5]))
    return projected_crs(given[0]) if given else None
