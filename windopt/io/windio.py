"""Farms in windIO 2: a plant's ``wind_farm``, alone or inside a ``wind_energy_system``.

windIO's own schema lets NaN and coordinates of different lengths pass, so both are checked here.
Of several layouts the first is used. The coordinate system may be a PROJ text, as windIO has it,
an EPSG code or a UTM zone.
"""

from math import pi
from typing import Any

from windopt.domain.farm import Farm
from windopt.domain.turbine import SG_8_167, Turbine, TurbineType
from windopt.errors import InvalidInput
from windopt.io.coordinates import projected_crs
from windopt.io.entries import Entry
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import CURVE_NOTE, DEFAULT_NOTE

RHO = 1.225  # kg/m3, the standard atmosphere's, for turbines given by C_p alone


def is_windio(document: Any) -> bool:
    """Tell whether a YAML document is a windIO plant."""
    return isinstance(document, dict) and ("layouts" in document or "wind_farm" in document)


def farm_from_windio(document: Any, source: str) -> Farm:
    """Read the wind farm of a windIO document.

    Parameters
    ----------
    document
        As parsed from YAML.
    source
        Where it comes from.

    Raises
    ------
    InvalidInput
        Naming the key that is missing or cannot be used.
    """
    plant = Entry(document)
    if "wind_farm" in plant:
        plant = plant["wind_farm"]
    layout, notes = _layout(plant["layouts"])
    x, y = layout["coordinates"]["x"].numbers, layout["coordinates"]["y"].numbers
    _require_length(layout["coordinates"]["y"], len(x))
    if "turbine_identifiers" in layout:
        names = [entry.label for entry in layout["turbine_identifiers"]]
        _require_length(layout["turbine_identifiers"], len(x))
    else:
        names, name_notes = distinct_names([None] * len(x))
        notes += name_notes
    types, type_notes = _types(plant, layout, len(x))
    return Farm(
        plant["name"].text,
        tuple(map(Turbine, names, x, y, types)),
        crs=_crs(layout["coordinates"]) or _crs(plant),
        substations=_substations(plant),
        source=source,
        notes=(*notes, *type_notes),
    )


def _require_length(entries: Entry, n: int) -> None:
    count = len(list(entries))
    if count != n:
        raise InvalidInput(entries.path, f"to hold {n} entries, one per turbine", count)


def _layout(layouts: Entry) -> tuple[Entry, tuple[str, ...]]:
    if isinstance(layouts.value, dict):
        return layouts, ()
    several = list(layouts)
    if not several:
        raise layouts.refuse("to hold a layout")
    note = f"The first of {len(several)} layouts is used."
    return several[0], (note,) if len(several) > 1 else ()


def _crs(entry: Entry) -> str | None:
    return projected_crs(entry["crs"].label, entry["crs"].path) if "crs" in entry else None


def _substations(plant: Entry) -> tuple[tuple[float, float], ...]:
    if "electrical_substations" not in plant:
        return ()
    places: list[tuple[float, float]] = []
    for entry in plant["electrical_substations"]:
        coordinates = entry["electrical_substation"]["coordinates"]
        x, y = coordinates["x"].numbers, coordinates["y"].numbers
        _require_length(coordinates["y"], len(x))
        places += zip(x, y, strict=True)
    return tuple(places)


def _types(plant: Entry, layout: Entry, n: int) -> tuple[list[TurbineType], tuple[str, ...]]:
    """Return the type of each turbine."""
    if "turbine_types" in layout:
        listed = layout["turbine_types"]
        _require_length(listed, n)
        types = {key: turbine_type(entry) for key, entry in plant["turbine_types"].items()}
        for entry in listed:
            if entry.label not in types:
                raise entry.refuse(f"to be one of {', '.join(types)}")
        curves = any(_has_curve(entry) for _, entry in plant["turbine_types"].items())
        return [types[entry.label] for entry in listed], (CURVE_NOTE,) if curves else ()
    if "turbines" in plant:
        notes = (CURVE_NOTE,) if _has_curve(plant["turbines"]) else ()
        return [turbine_type(plant["turbines"])] * n, notes
    return [SG_8_167] * n, (DEFAULT_NOTE,)


def turbine_type(entry: Entry) -> TurbineType:
    """Read one of windIO's turbines; wind speeds it leaves out are those of the SG 8.0-167 DD."""
    area = pi * entry["rotor_diameter"].number ** 2 / 4
    performance = entry["performance"]

    def given(key: str, default: float) -> float:
        return performance[key].number if key in performance else default

    return TurbineType(
        entry["name"].text,
        rated_power=_rated_power(performance, area),
        swept_area=area,
        cut_in=given("cutin_wind_speed", SG_8_167.cut_in),
        cut_out=given("cutout_wind_speed", SG_8_167.cut_out),
        hub_height=entry["hub_height"].number if "hub_height" in entry else None,
    )


def _has_curve(entry: Entry) -> bool:
    return any(curve in entry["performance"] for curve in ("power_curve", "Cp_curve"))


def _rated_power(performance: Entry, area: float) -> float:
    """Return the rated power [W], or the most that the curve given in its place reaches."""
    if "rated_power" in performance:
        return performance["rated_power"].number
    if "power_curve" in performance:
        return max(performance["power_curve"]["power_values"].numbers, default=0.0)
    if "Cp_curve" in performance:
        C_p, v = performance["Cp_curve"]["Cp_values"], performance["Cp_curve"]["Cp_wind_speeds"]
        _require_length(v, len(C_p.numbers))
        watts = (RHO / 2 * area * c * u**3 for c, u in zip(C_p.numbers, v.numbers, strict=True))
        return max(watts, default=0.0)
    raise performance.refuse("to give rated_power, a power_curve or a Cp_curve")
