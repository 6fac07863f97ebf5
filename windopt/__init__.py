"""Yaw set-points and UAV inspection flights for wind farms, each with a proof or an honest gap.

Everything below is imported when first used, so that ``import windopt`` stays light.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from windopt.checking import Report, check
    from windopt.comparison import compare
    from windopt.domain.certificate import Certificate
    from windopt.domain.farm import Farm
    from windopt.domain.fleet import Fleet, Station, Uav
    from windopt.domain.plan import InspectionPlan, Plan, YawPlan
    from windopt.domain.power_curve import PowerCurve
    from windopt.domain.steering import Steering
    from windopt.domain.turbine import Turbine, TurbineType
    from windopt.domain.wind import Wind, WindForecast, WindSeries
    from windopt.errors import InvalidInput
    from windopt.planning.certification import certify
    from windopt.planning.inspection import plan_inspection
    from windopt.planning.plan import plan
    from windopt.planning.turbine_yaw import plan_turbine_yaw
    from windopt.planning.yaw import plan_yaw
    from windopt.result import Result, Status
    from windopt.solving import relax, solve
    from windopt.versions import show_versions

__version__ = "0.1.0"

_ROOMS = {
    "Certificate": "windopt.domain.certificate",
    "Farm": "windopt.domain.farm",
    "Fleet": "windopt.domain.fleet",
    "InspectionPlan": "windopt.domain.plan",
    "InvalidInput": "windopt.errors",
    "Plan": "windopt.domain.plan",
    "PowerCurve": "windopt.domain.power_curve",
    "Report": "windopt.checking",
    "Result": "windopt.result",
    "Station": "windopt.domain.fleet",
    "Status": "windopt.result",
    "Steering": "windopt.domain.steering",
    "Turbine": "windopt.domain.turbine",
    "TurbineType": "windopt.domain.turbine",
    "Uav": "windopt.domain.fleet",
    "Wind": "windopt.domain.wind",
    "WindForecast": "windopt.domain.wind",
    "WindSeries": "windopt.domain.wind",
    "YawPlan": "windopt.domain.plan",
    "certify": "windopt.planning.certification",
    "check": "windopt.checking",
    "compare": "windopt.comparison",
    "plan": "windopt.planning.plan",
    "plan_inspection": "windopt.planning.inspection",
    "plan_turbine_yaw": "windopt.planning.turbine_yaw",
    "plan_yaw": "windopt.planning.yaw",
    "relax": "windopt.solving",
    "show_versions": "windopt.versions",
    "solve": "windopt.solving",
}

__all__ = [
    "Certificate",
    "Farm",
    "Fleet",
    "InspectionPlan",
    "InvalidInput",
    "Plan",
    "PowerCurve",
    "Report",
    "Result",
    "Station",
    "Status",
    "Steering",
    "Turbine",
    "TurbineType",
    "Uav",
    "Wind",
    "WindForecast",
    "WindSeries",
    "YawPlan",
    "certify",
    "check",
    "compare",
    "plan",
    "plan_inspection",
    "plan_turbine_yaw",
    "plan_yaw",
    "relax",
    "show_versions",
    "solve",
]


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_ROOMS[name]), name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
