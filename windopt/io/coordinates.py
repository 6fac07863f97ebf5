"""Coordinate systems: what a source may call one, and the way between degrees and metres."""

import re
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from pyproj import CRS, Transformer
from pyproj.exceptions import CRSError

from windopt.errors import InvalidInput

Floats = NDArray[np.float64]
UTM_ZONE = re.compile(r"(?:utm\s*(?:zone)?\s*)?(\d{1,2})\s*([a-z])", re.IGNORECASE)


def utm_crs(zone: int, band: str) -> str:
    """Return the EPSG code of a UTM zone; its latitude band tells north from south.

    Bands C to M lie south of the equator and N to X north of it.
    """
    if not (1 <= zone <= 60 and len(band) == 1 and band.upper() in "CDEFGHJKLMNPQRSTUVWX"):
        raise InvalidInput("UTM zone", "such as 30U or 19H", f"{zone}{band}")
    return f"EPSG:{32600 + zone if band.upper() >= 'N' else 32700 + zone}"


def projected_crs(given: str | int, field: str = "crs") -> str:
    """Return the CRS that a source gives, if its coordinates are metres on a plane.

    Parameters
    ----------
    given
        An EPSG code (``32630`` or ``"EPSG:32630"``), a UTM zone with its latitude band
        (``"30U"``), or a PROJ or WKT text.
    field
        What to call it in a complaint.

    Raises
    ------
    InvalidInput
        If nobody knows the CRS, or it is not a projected one in metres.
    """
    zone = UTM_ZONE.fullmatch(str(given).strip())
    if zone:
        return utm_crs(int(zone[1]), zone[2])
    try:
        crs = CRS.from_user_input(int(given) if str(given).isdecimal() else given)
    except (CRSError, ValueError, OverflowError):
        raise InvalidInput(field, "to be an EPSG code, UTM zone or PROJ text", given) from None
    if not crs.is_projected or {axis.unit_name for axis in crs.axis_info} != {"metre"}:
        raise InvalidInput(field, "to be a projected system in metres", crs.name)
    code = crs.to_epsg()
    return f"EPSG:{code}" if code else str(given)


def utm_crs_of(longitude: Floats, latitude: Floats, field: str = "lon and lat") -> str:
    """Return the UTM zone in which the middle of some points [deg] lies."""
    if not (np.all(np.abs(longitude) <= 180) and np.all(np.abs(latitude) <= 84)):
        raise InvalidInput(field, "within 180 and 84 degrees", "a point beyond")
    zone = int((float(np.mean(longitude)) + 180) // 6) % 60 + 1
    return utm_crs(zone, "N" if float(np.mean(latitude)) >= 0 else "M")


@lru_cache
def _transformer(crs: str) -> Transformer:
    return Transformer.from_crs("EPSG:4326", crs, always_xy=True)


def to_metres(crs: str, longitude: Floats, latitude: Floats) -> tuple[Floats, Floats]:
    """Return easting and northing [m] of points [deg, WGS84]."""
    x, y = _transformer(crs).transform(longitude, latitude)
    return np.asarray(x, dtype=float), np.asarray(y, dtype=float)


def to_degrees(crs: str, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Return longitude and latitude [deg, WGS84] of points [m]."""
    longitude, latitude = _transformer(crs).transform(x, y, direction="INVERSE")
    return np.asarray(longitude, dtype=float), np.asarray(latitude, dtype=float)
