"""Farms in FLORIS v4's input files: ``farm.layout_x``, ``layout_y`` and ``turbine_type``."""

from functools import cache
from math import pi
from pathlib import Path
from typing import Any

from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY, YAW_EXPONENT, PowerCurve
from windopt.domain.turbine import SG_8_167, Turbine, TurbineType
from windopt.errors import InvalidInput
from windopt.io.entries import Entry
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import CURVE_NOTE
from windopt.io.yaml_files import read_yaml

TURBINES = Path(__file__).parents[1] / "data" / "turbines"

LIBRARY = ("nrel_5MW", "iea_10MW", "iea_15MW", "iea_22MW")
"""FLORIS's own turbines, as published in FLORIS 4.7's turbine library."""


@cache
def library_turbine(name: str) -> TurbineType:
    """Return one of FLORIS's own turbines."""
    return turbine_type(Entry(read_yaml(TURBINES / f"{name}.yaml")))


def is_floris(document: Any) -> bool:
    """Tell whether a YAML document is a FLORIS input file."""
    return isinstance(document, dict) and "farm" in document


def farm_from_floris(document: Any, source: str) -> Farm:
    """Read the farm of a FLORIS v4 input file.

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
    top = Entry(document)
    farm = top["farm"]
    x, y = farm["layout_x"].numbers, farm["layout_y"].numbers
    if len(x) != len(y):
        raise InvalidInput("farm.layout_y", f"to hold {len(x)} numbers like layout_x", len(y))
    names, name_notes = distinct_names([None] * len(x))
    types, type_notes = _types(farm["turbine_type"], len(x))
    return Farm(
        top["name"].text if "name" in top else "FLORIS farm",
        tuple(map(Turbine, names, x, y, types)),
        source=source,
        notes=(*name_notes, *type_notes),
    )


def _types(entry: Entry, n: int) -> tuple[list[TurbineType], tuple[str, ...]]:
    """Return the type of each turbine: one for all, or one each."""
    types: list[TurbineType] = []
    unknown: list[str] = []
    for given in entry if isinstance(entry.value, list) else (entry,):
        if isinstance(given.value, dict):
            types.append(turbine_type(given))
        else:
            known = given.text in LIBRARY
            types.append(library_turbine(given.text) if known else SG_8_167)
            unknown += [given.text] if given.text not in LIBRARY else []
    if len(types) not in (1, n):
        raise InvalidInput(entry.path, f"to hold 1 type or {n}, one per turbine", len(types))
    notes = (
        f"The turbine {name} is not in FLORIS's library; {SG_8_167.name} is assumed."
        for name in dict.fromkeys(unknown)
    )
    curve_note = (CURVE_NOTE,) if any(t.curve is None and t != SG_8_167 for t in types) else ()
    return types * n if len(types) == 1 else types, (*notes, *curve_note)


def turbine_type(entry: Entry) -> TurbineType:
    """Read one of FLORIS's turbine definitions, whose powers are in kW."""
    table = entry["power_thrust_table"]
    power, wind_speed = table["power"], table["wind_speed"]
    if len(power.numbers) != len(wind_speed.numbers):
        raise InvalidInput(power.path, "as long as wind_speed", len(power.numbers))
    running = [v for v, p in zip(wind_speed.numbers, power.numbers, strict=True) if p > 0]
    if not running:
        raise InvalidInput(power.path, "to hold a positive power", "none")
    return TurbineType(
        entry["turbine_type"].text if "turbine_type" in entry else "FLORIS turbine",
        rated_power=1e3 * max(power.numbers),
        swept_area=pi * entry["rotor_diameter"].number ** 2 / 4,
        cut_in=min(running),
        cut_out=max(running),
        hub_height=entry["hub_height"].number if "hub_height" in entry else None,
        curve=_curve(table) if "thrust_coefficient" in table else None,
    )


def _curve(table: Entry) -> PowerCurve:
    """Read a table that has thrust coefficients too."""

    def given(key: str, default: float) -> float:
        return table[key].number if key in table else default

    return PowerCurve(
        tuple(table["wind_speed"].numbers),
        tuple(1e3 * kilowatts for kilowatts in table["power"].numbers),
        tuple(table["thrust_coefficient"].numbers),
        given("ref_air_density", STANDARD_AIR_DENSITY),
        given("cosine_loss_exponent_yaw", YAW_EXPONENT),
    )
