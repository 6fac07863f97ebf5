"""Records of plans, read back into plans; the counterpart of :mod:`windopt.io.plan_records`."""

import re
from collections.abc import Collection
from enum import StrEnum
from math import inf, radians
from typing import Any, TypeVar

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import (
    Flight,
    InspectionPlan,
    LeftOut,
    Plan,
    SetPoint,
    SpeedRule,
    Unreachable,
    YawPlan,
)
from windopt.domain.steering import Pace, Steering
from windopt.domain.wind import Wind, WindForecast
from windopt.errors import InvalidInput
from windopt.io.entries import Entry
from windopt.io.farm_reader import farm_of, pair_of
from windopt.io.plan_records import SCHEMA, VERSION
from windopt.result import Result, Status

Recorded = Result[InspectionPlan] | Result[YawPlan] | Plan
Solution = TypeVar("Solution")
Choice = TypeVar("Choice", bound=StrEnum)

# NumPy itself would also take "now", and stamps with an offset.
TIME = re.compile(r"\d{4}-\d\d-\d\d(T\d\d(:\d\d(:\d\d(\.\d{1,9})?)?)?)?")


def plan_from_record(document: Any) -> Recorded:
    """Rebuild what was recorded.

    Parameters
    ----------
    document
        As parsed from JSON.

    Returns
    -------
    Result or Plan
        By the record's ``kind``: a result with an inspection or a yaw plan, or a whole plan.

    Raises
    ------
    InvalidInput
        Naming the key that is missing or cannot be used.
    """
    record = Entry(document)
    if record["schema"].value != SCHEMA:
        raise record["schema"].refuse(f"to be {SCHEMA!r}")
    if record["version"].value != VERSION:
        raise record["version"].refuse(f"to be {VERSION}")
    kind = record["kind"].text
    if kind not in ("inspection", "yaw", "plan"):
        raise record["kind"].refuse("to be inspection, yaw or plan")
    farm = farm_of(record["farm"])
    if kind == "yaw":
        return _yaw_result(record, farm)
    inspection = _result(record, _inspection(record, farm), unproved=-inf)
    if kind == "inspection":
        return inspection
    yaw = tuple(_yaw_result(step, farm) for step in record["yaw"])
    pace = _pace(record["pace"]) if "pace" in record else None
    return Plan(_time(record["time"]), _forecast(record["forecast"]), yaw, inspection, pace)


def _result(record: Entry, solution: Solution, unproved: float) -> Result[Solution]:
    """Read an outcome; ``unproved`` is the bound that says nothing."""
    bound, asked_gap = record.nullable("bound"), record.nullable("asked_gap")
    return Result(
        _choice(record["status"], Status),
        solution,
        record["objective"].number,
        unproved if bound is None else bound.number,
        record["runtime"].number,
        record["bound_source"].text,
        record["reason"].text,
        inf if asked_gap is None else asked_gap.number,
    )


def _yaw_result(record: Entry, farm: Farm) -> Result[YawPlan]:
    return _result(record, _yaw(record, farm), unproved=inf)


def _choice(entry: Entry, choices: type[Choice]) -> Choice:
    if entry.text not in set(choices):
        raise entry.refuse(f"to be one of {', '.join(choices)}")
    return choices(entry.text)


def _inspection(record: Entry, farm: Farm) -> InspectionPlan:
    reasons, dwell = record["unreachable_reasons"], record["dwell"]
    unreachable = record["unreachable"].texts
    _refuse_others(dwell, farm.names, "to name a turbine of the farm")
    _refuse_others(reasons, unreachable, "to name an unreachable turbine")
    worth, left_out = _left_out(record, farm)
    return InspectionPlan(
        farm,
        Fleet(tuple(_station(entry) for entry in record["stations"])),
        _wind(record["wind"]),
        tuple(dwell[name].number for name in farm.names),
        tuple(_flight(entry) for entry in record["flights"]),
        tuple(Unreachable(name, reasons[name].text) for name in unreachable),
        _choice(record["rule"], SpeedRule),
        worth,
        left_out,
        _assignment(record["assignment"], farm) if "assignment" in record else None,
    )


def _left_out(record: Entry, farm: Farm) -> tuple[tuple[float, ...] | None, tuple[LeftOut, ...]]:
    """Read what turbines are worth, where it is said, and which are left out."""
    if "worth" not in record:
        return None, ()
    worth, reasons = record["worth"], record["left_out_reasons"]
    names = record["left_out"].texts
    _refuse_others(worth, farm.names, "to name a turbine of the farm")
    _refuse_others(reasons, names, "to name a turbine that is left out")
    left_out = tuple(LeftOut(name, reasons[name].text) for name in names)
    return tuple(worth[name].number for name in farm.names), left_out


def _assignment(entry: Entry, farm: Farm) -> tuple[tuple[str, ...], ...]:
    _refuse_others(entry, farm.names, "to name a turbine of the farm")
    return tuple(tuple(entry[name].texts) for name in farm.names)


def _refuse_others(entry: Entry, names: Collection[str], expected: str) -> None:
    """Refuse keys other than ``names``."""
    for name, value in entry.items():
        if name not in names:
            raise InvalidInput(value.path, expected, repr(name))


def _station(entry: Entry) -> Station:
    most = entry["max_flights"].number if "max_flights" in entry else None
    if most is not None and most != int(most):
        raise entry["max_flights"].refuse("to be a whole number")
    return Station(
        entry["id"].text,
        entry["x"].number,
        entry["y"].number,
        _uav(entry["uav"]),
        None if most is None else int(most),
    )


def _uav(entry: Entry) -> Uav:
    wind_max = entry.nullable("wind_max")
    return Uav(
        entry["name"].text,
        entry["airspeed"].number,
        entry["t_max"].number,
        inf if wind_max is None else wind_max.number,
        entry["ground_speed_cap"].truth,
    )


def _flight(entry: Entry) -> Flight:
    return Flight(
        entry["station"].text,
        entry["uav"].text,
        tuple(entry["turbines"].texts),
        tuple(entry["legs"].numbers),
        entry["duration"].number,
    )


def _yaw(record: Entry, farm: Farm) -> YawPlan:
    return YawPlan(
        farm,
        _wind(record["wind"]),
        tuple(_set_point(entry, farm) for entry in record["turbines"]),
        record["power_baseline"].number,
        record["air_density"].number,
        None if (steering := record.nullable("steering")) is None else _steering(steering),
    )


def _steering(entry: Entry) -> Steering:
    cap = entry.nullable("farm_cap")
    lower, upper = pair_of(entry["bounds"])
    return Steering(
        entry["turbulence"].number,
        radians(lower),
        radians(upper),
        radians(entry["direction_std"].number),
        tuple((_wind(row["wind"]), row["weight"].number) for row in entry["scenarios"]),
        inf if cap is None else cap.number,
        entry["shear"].number,
    )


def _pace(entry: Entry) -> Pace:
    return Pace(radians(entry["rate"].number), entry["threshold"].number)


def _set_point(entry: Entry, farm: Farm) -> SetPoint:
    if entry["name"].text not in farm.names:
        raise entry["name"].refuse("to name a turbine of the farm")
    pitch, tip_speed_ratio = entry.nullable("pitch"), entry.nullable("tip_speed_ratio")
    return SetPoint(
        entry["name"].text,
        nacelle=radians(entry["nacelle"].number),
        misalignment=radians(entry["misalignment"].number),
        pitch=None if pitch is None else radians(pitch.number),
        tip_speed_ratio=None if tip_speed_ratio is None else tip_speed_ratio.number,
        wind_speed=entry["wind_speed"].number,
        power=entry["power"].number,
        maximum=entry["maximum"].number,
    )


def _wind(entry: Entry) -> Wind:
    return Wind(entry["u"].number, entry["v"].number)


def _forecast(entry: Entry) -> WindForecast:
    steps = list(entry["steps"])
    return WindForecast(
        _time(entry["issued"]),
        np.array([_time(step["time"]) for step in steps]),
        np.array([step["wind_speed"].number for step in steps]),
        np.array([radians(step["wind_direction"].number) for step in steps]),
        entry["method"].text,
        tuple(entry["notes"].texts),
    )


def _time(entry: Entry) -> np.datetime64:
    try:
        if TIME.fullmatch(entry.text):
            return np.datetime64(entry.text)
    except ValueError:
        pass
    raise entry.refuse("to be a time such as 2011-04-13T22:00")
