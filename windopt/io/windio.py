"""Farms in windIO 2: a plant's ``wind_farm``, alone or inside a ``wind_energy_system``.

windIO's own schema lets NaN and coordinates of different lengths pass, so both are checked here.
Of several layouts the first is used. The coordinate system may be a PROJ text, as windIO has it,
an EPSG code or a UTM zone.
"""

from itertools import pairwise
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY as RHO
from windopt.domain.power_curve import STEP, PowerCurve
from windopt.domain.turbine import SG_8_167, Turbine, TurbineType
from windopt.errors import InvalidInput
from windopt.io.coordinates import projected_crs
from windopt.io.entries import Entry
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import CURVE_NOTE, DEFAULT_NOTE


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
        notes = {note for _, entry in plant["turbine_types"].items() for note in _curve_note(entry)}
        return [types[entry.label] for entry in listed], tuple(notes)
    if "turbines" in plant:
        return [turbine_type(plant["turbines"])] * n, _curve_note(plant["turbines"])
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
        curve=_curve(performance, area),
    )


def _curve_note(entry: Entry) -> tuple[str, ...]:
    """Say that curves are not used, where there are some without thrust coefficients."""
    curves = any(curve in entry["performance"] for curve in ("power_curve", "Cp_curve"))
    return (CURVE_NOTE,) if curves and "Ct_curve" not in entry["performance"] else ()


def _curve(performance: Entry, area: float) -> PowerCurve | None:
    """Return power and thrust at all speeds with a power, where both are given."""
    if "Ct_curve" not in performance:
        return None
    C_T, v_T = _table(performance["Ct_curve"], "Ct_values", "Ct_wind_speeds")
    if "power_curve" in performance:
        p, v = _table(performance["power_curve"], "power_values", "power_wind_speeds")
        w = _within(v, [*v, *v_T])
        power = np.interp(w, v, p)
    elif "Cp_curve" in performance:
        C_p, v = _table(performance["Cp_curve"], "Cp_values", "Cp_wind_speeds")
        w = _within(v, [*v, *v_T, *np.arange(min(v), max(v), STEP)])
        power = RHO / 2 * area * np.interp(w, v, C_p) * w**3
        if "rated_power" in performance:
            power = np.minimum(power, performance["rated_power"].number)
    else:
        return None
    thrust = np.interp(w, v_T, C_T, left=0.0, right=0.0)
    return PowerCurve(tuple(w.tolist()), tuple(power.tolist()), tuple(thrust.tolist()))


def _within(v: list[float], speeds: list[float]) -> NDArray[np.float64]:
    """Return the distinct ones of ``speeds`` that the table over ``v`` reaches."""
    w = np.unique(speeds)
    return w[(w >= min(v)) & (w <= max(v))]


def _table(curve: Entry, values: str, wind_speeds: str) -> tuple[list[float], list[float]]:
    """Return a curve's values and the wind speeds they hold at, which must increase."""
    C, v = curve[values].numbers, curve[wind_speeds].numbers
    _require_length(curve[wind_speeds], len(C))
    if len(v) < 2 or any(low >= high for low, high in pairwise(v)):
        raise curve[wind_speeds].refuse("to be two or more, increasing")
    return C, v


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
