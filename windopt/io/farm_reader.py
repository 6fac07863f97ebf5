"""Farms read back from the record of a plan: turbines, their types and power curves."""

from windopt.domain.farm import Farm
from windopt.domain.power_curve import PowerCurve
from windopt.domain.turbine import Turbine, TurbineType
from windopt.io.entries import Entry


def farm_of(entry: Entry) -> Farm:
    """Rebuild a farm with its turbine types.

    Raises
    ------
    InvalidInput
        Naming the key that is missing or cannot be used.
    """
    crs = entry.nullable("crs")
    types = {key: _turbine_type(given) for key, given in entry["turbine_types"].items()}
    return Farm(
        entry["name"].text,
        tuple(_turbine(turbine, types) for turbine in entry["turbines"]),
        None if crs is None else crs.text,
        tuple(pair_of(place) for place in entry["substations"]),
        entry["source"].text,
        tuple(entry["notes"].texts),
    )


def pair_of(entry: Entry) -> tuple[float, float]:
    """Return two numbers: a place, or bounds."""
    if len(entry.numbers) != 2:
        raise entry.refuse("to be a pair of numbers")
    x, y = entry.numbers
    return x, y


def _turbine(entry: Entry, types: dict[str, TurbineType]) -> Turbine:
    if entry["type"].text not in types:
        raise entry["type"].refuse(f"to be one of {', '.join(types)}")
    return Turbine(
        entry["name"].text, entry["x"].number, entry["y"].number, types[entry["type"].text]
    )


def _turbine_type(entry: Entry) -> TurbineType:
    hub_height = entry.nullable("hub_height")
    return TurbineType(
        entry["name"].text,
        entry["rated_power"].number,
        entry["swept_area"].number,
        entry["cut_in"].number,
        entry["cut_out"].number,
        None if hub_height is None else hub_height.number,
        entry["power_coefficient"].text,
        None if (curve := entry.nullable("curve")) is None else _curve(curve),
    )


def _curve(entry: Entry) -> PowerCurve:
    return PowerCurve(
        tuple(entry["wind_speeds"].numbers),
        tuple(entry["powers"].numbers),
        tuple(entry["thrust_coefficients"].numbers),
        entry["air_density"].number,
        entry["yaw_exponent"].number,
    )
