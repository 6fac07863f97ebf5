"""Farm, stations and flights as GeoJSON (RFC 7946), for any map: longitude and latitude, WGS 84."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.plan import Flight, InspectionPlan
from windopt.errors import InvalidInput
from windopt.io.coordinates import to_degrees
from windopt.io.whole_files import write_whole

DECIMALS = 7  # of a degree: one centimetre

Place = tuple[float, float]
Feature = dict[str, Any]


def geojson(plan: Farm | InspectionPlan) -> dict[str, Any]:
    """Return a feature collection of the turbines, and of a plan's stations and flights.

    Every feature has a property ``kind``: turbine, substation, station or flight. Of a plan each
    turbine says whether it is ``unreachable``, and then the ``reason``.

    Raises
    ------
    InvalidInput
        If the farm's coordinate system is unknown.
    """
    farm = plan if isinstance(plan, Farm) else plan.farm
    if farm.crs is None:
        raise InvalidInput("the farm's crs", "to be known, for longitude and latitude", "none")
    features = [_point(farm.crs, xy, kind="substation") for xy in farm.substations]
    if isinstance(plan, Farm):
        features += [
            _point(farm.crs, (t.x, t.y), kind="turbine", name=t.name) for t in farm.turbines
        ]
    else:
        features += _inspection(plan, farm.crs)
    return {"type": "FeatureCollection", "features": features}


def write_geojson(plan: Farm | InspectionPlan, path: str | Path, *, force: bool = False) -> Path:
    """Write :func:`geojson` to a file.

    Parameters
    ----------
    force
        Whether a file that is already there may be replaced.
    """
    text = json.dumps(geojson(plan), indent=1, allow_nan=False) + "\n"
    return write_whole(path, text, force=force)


def _inspection(plan: InspectionPlan, crs: str) -> list[Feature]:
    """Return the features of a plan: turbines, stations, then flights."""
    reasons = {left_out.turbine: left_out.reason for left_out in plan.unreachable}
    features = []
    for turbine in plan.farm.turbines:
        known = {"kind": "turbine", "name": turbine.name, "unreachable": turbine.name in reasons}
        if turbine.name in reasons:
            known["reason"] = reasons[turbine.name]
        features.append(_point(crs, (turbine.x, turbine.y), **known))
    features += [
        _point(crs, (s.x, s.y), kind="station", name=s.name, uav=s.uav.name)
        for s in plan.fleet.stations
    ]
    places = {t.name: (t.x, t.y) for t in plan.farm.turbines}
    homes = {s.name: (s.x, s.y) for s in plan.fleet.stations}
    for number, flight in enumerate(plan.flights, start=1):
        home = homes[flight.station]
        path = [home, *(places[name] for name in flight.turbines), home]
        features.append(_line(crs, path, number, flight))
    return features


def _degrees(crs: str, places: list[Place]) -> list[list[float]]:
    longitude, latitude = to_degrees(crs, *np.array(places).T)
    pairs: list[list[float]] = np.stack([longitude, latitude], axis=-1).round(DECIMALS).tolist()
    return pairs


def _point(crs: str, place: Place, **properties: object) -> Feature:
    geometry = {"type": "Point", "coordinates": _degrees(crs, [place])[0]}
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def _line(crs: str, places: list[Place], number: int, flight: Flight) -> Feature:
    return {
        "type": "Feature",
        "geometry": {"type": "LineString", "coordinates": _degrees(crs, places)},
        "properties": {
            "kind": "flight",
            "number": number,
            "station": flight.station,
            "uav": flight.uav,
            "turbines": list(flight.turbines),
            "duration": float(flight.duration),
        },
    }
