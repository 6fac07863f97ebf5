"""Plans as records: nested dictionaries of texts and numbers, ready for JSON.

A record is SI throughout, but for directions and blade pitch, which are in degrees. What is not
finite, such as a bound that nobody proved, is null. Equal plans give equal records, key by key.

A record holds a plan: a result without one has nothing to record, and ``found`` says why.
"""

from collections.abc import Iterable
from math import degrees, isfinite
from typing import Any

from windopt.domain.farm import Farm
from windopt.domain.fleet import Station, Uav
from windopt.domain.plan import Flight, InspectionPlan, Plan, SetPoint, YawPlan
from windopt.domain.power_curve import PowerCurve
from windopt.domain.steering import Pace, Steering
from windopt.domain.turbine import TurbineType
from windopt.domain.wind import Wind, WindForecast
from windopt.result import Result

Record = dict[str, Any]

SCHEMA = "windopt/plan"
VERSION = 2


def inspection_record(result: Result[InspectionPlan]) -> Record:
    """Record the flights of an inspection."""
    plan = result.found()
    return {**_head("inspection"), **_outcome(result), **_inspection(plan), **_farm(plan.farm)}


def yaw_record(result: Result[YawPlan]) -> Record:
    """Record the set-points of a farm."""
    plan = result.found()
    return {**_head("yaw"), **_outcome(result), **_yaw(plan), **_farm(plan.farm)}


def plan_record(plan: Plan) -> Record:
    """Record the whole answer: the inspection's record, the forecast and a yaw record per step."""
    return {
        **inspection_record(plan.inspection),
        "kind": "plan",
        "time": str(plan.time),
        "forecast": _forecast(plan.forecast),
        "yaw": [
            {"time": str(time), **_outcome(step), **_yaw(step.found())}
            for time, step in zip(plan.forecast.time, plan.yaw, strict=True)
        ],
        **({} if plan.pace is None else {"pace": _pace(plan.pace)}),
    }


def _head(kind: str) -> Record:
    return {"schema": SCHEMA, "version": VERSION, "kind": kind}


def _finite(number: float) -> float | None:
    return float(number) if isfinite(number) else None


def _degrees(radians: float) -> float:
    """Return an angle in degrees, rounded so that a plan read back gives the same record.

    The way to radians and back errs by some 1e-13 degrees.
    """
    return round(degrees(radians), 12)


def _outcome(result: Result[Any]) -> Record:
    return {
        "status": str(result.status),
        "objective": float(result.objective),
        "bound": _finite(result.bound),
        "gap": _finite(result.gap),
        "asked_gap": _finite(result.asked_gap),
        "bound_source": result.bound_source,
        "runtime": _finite(result.runtime),
        "reason": result.reason,
    }


def _inspection(plan: InspectionPlan) -> Record:
    return {
        "wind": _wind(plan.wind),
        "rule": str(plan.rule),
        "stations": [station_record(station) for station in plan.fleet.stations],
        "flights": [_flight(flight) for flight in plan.flights],
        "unreachable": [each.turbine for each in plan.unreachable],
        "unreachable_reasons": {each.turbine: each.reason for each in plan.unreachable},
        "dwell": dict(zip(plan.farm.names, map(float, plan.dwell), strict=True)),
        **_choice(plan),
    }


def _choice(plan: InspectionPlan) -> Record:
    """Record what may be left out and who may inspect what, where that was restricted."""
    record: Record = {}
    if plan.worth is not None:
        record["worth"] = dict(zip(plan.farm.names, map(float, plan.worth), strict=True))
        record["left_out"] = [left_out.turbine for left_out in plan.left_out]
        record["left_out_reasons"] = {left.turbine: left.reason for left in plan.left_out}
        record["duration"] = float(plan.duration)
    if plan.assignment is not None:
        names = zip(plan.farm.names, plan.assignment, strict=True)
        record["assignment"] = {turbine: list(stations) for turbine, stations in names}
    return record


def _yaw(plan: YawPlan) -> Record:
    rated = {turbine.name: turbine.type.rated_power for turbine in plan.farm.turbines}
    return {
        "wind": _wind(plan.wind),
        "air_density": float(plan.air_density),
        "power": float(plan.power),
        "power_baseline": float(plan.power_baseline),
        "gain": _finite(plan.gain),
        "steering": None if plan.steering is None else _steering(plan.steering),
        "turbines": [_set_point(point, rated[point.turbine]) for point in plan.set_points],
    }


def _steering(steering: Steering) -> Record:
    return {
        "turbulence": float(steering.turbulence),
        "bounds": [_degrees(steering.lower), _degrees(steering.upper)],
        "direction_std": _degrees(steering.direction_std),
        "scenarios": [
            {"wind": _wind(wind), "weight": float(weight)} for wind, weight in steering.scenarios
        ],
        "farm_cap": _finite(steering.farm_cap),
        "shear": float(steering.shear),
    }


def _pace(pace: Pace) -> Record:
    return {"rate": _degrees(pace.rate), "threshold": float(pace.threshold)}


def _wind(wind: Wind) -> Record:
    """Speed and direction for people; u and v are what is read back."""
    return {
        "speed": wind.speed,
        "direction": _degrees(wind.theta_met),
        "u": float(wind.u),
        "v": float(wind.v),
    }


def station_record(station: Station) -> Record:
    """Record a station with its UAVs."""
    return {
        "id": station.name,
        "x": float(station.x),
        "y": float(station.y),
        "uav": _uav(station.uav),
        **({} if station.max_flights is None else {"max_flights": int(station.max_flights)}),
    }


def _uav(uav: Uav) -> Record:
    return {
        "name": uav.name,
        "airspeed": float(uav.airspeed),
        "t_max": float(uav.t_max),
        "wind_max": _finite(uav.wind_max),
        "ground_speed_cap": uav.ground_speed_cap,
    }


def _flight(flight: Flight) -> Record:
    return {
        "uav": flight.uav,
        "station": flight.station,
        "turbines": list(flight.turbines),
        "legs": [float(leg) for leg in flight.legs],
        "duration": float(flight.duration),
    }


def _set_point(point: SetPoint, rated_power: float) -> Record:
    return {
        "name": point.turbine,
        "yaw": _degrees(point.misalignment),
        "misalignment": _degrees(point.misalignment),
        "nacelle": _degrees(point.nacelle),
        "pitch": None if point.pitch is None else _degrees(point.pitch),
        "tip_speed_ratio": None if point.tip_speed_ratio is None else float(point.tip_speed_ratio),
        "wind_speed": float(point.wind_speed),
        "power": float(point.power),
        "maximum": float(point.maximum),
        "rated_power": float(rated_power),
    }


def _forecast(forecast: WindForecast) -> Record:
    steps = zip(forecast.time, forecast.speed, forecast.theta_met, strict=True)
    return {
        "issued": str(forecast.issued),
        "method": forecast.method,
        "steps": [
            {"time": str(time), "wind_speed": float(speed), "wind_direction": _degrees(theta)}
            for time, speed, theta in steps
        ],
        "notes": list(forecast.notes),
    }


def _farm(farm: Farm) -> Record:
    keys = _type_keys(turbine.type for turbine in farm.turbines)
    return {
        "farm": {
            "name": farm.name,
            "crs": farm.crs,
            "source": farm.source,
            "notes": list(farm.notes),
            "substations": [[float(x), float(y)] for x, y in farm.substations],
            "turbine_types": {key: _turbine_type(type_) for type_, key in keys.items()},
            "turbines": [
                {"name": t.name, "x": float(t.x), "y": float(t.y), "type": keys[t.type]}
                for t in farm.turbines
            ],
        }
    }


def _type_keys(types: Iterable[TurbineType]) -> dict[TurbineType, str]:
    """Return a distinct key for each type: its name, numbered where two types share it."""
    keys: dict[TurbineType, str] = {}
    for type_ in dict.fromkeys(types):
        key, count = type_.name, 2
        while key in keys.values():
            key, count = f"{type_.name} ({count})", count + 1
        keys[type_] = key
    return keys


def _turbine_type(type_: TurbineType) -> Record:
    return {
        "name": type_.name,
        "rated_power": float(type_.rated_power),
        "swept_area": float(type_.swept_area),
        "cut_in": float(type_.cut_in),
        "cut_out": float(type_.cut_out),
        "hub_height": None if type_.hub_height is None else float(type_.hub_height),
        "power_coefficient": type_.power_coefficient,
        "curve": None if type_.curve is None else _curve(type_.curve),
    }


def _curve(curve: PowerCurve) -> Record:
    return {
        "wind_speeds": list(map(float, curve.wind_speeds)),
        "powers": list(map(float, curve.powers)),
        "thrust_coefficients": list(map(float, curve.thrust_coefficients)),
        "air_density": float(curve.air_density),
        "yaw_exponent": float(curve.yaw_exponent),
    }
