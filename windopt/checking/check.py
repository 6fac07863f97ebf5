"""The one door of the checker: any plan, with or without the promises of its result."""

from collections.abc import Iterator
from itertools import pairwise
from math import inf, isclose, isfinite, isnan
from typing import Any

from windopt.checking.inspection import check_inspection
from windopt.checking.pace import too_fast
from windopt.checking.report import Report
from windopt.checking.yaw import check_yaw, power_to_beat
from windopt.domain.certificate import Certificate
from windopt.domain.plan import InspectionPlan, Plan, YawPlan
from windopt.errors import InvalidInput, require_kind
from windopt.result import Result, Status

Checkable = Plan | InspectionPlan | YawPlan | Result[InspectionPlan] | Result[YawPlan]

UNTOUCHED = Report(unverified=("it is not looked at before the plan passes",))
TOLERANCE = 1e-6
"""Relative; the accuracy to which solvers keep their own constraints."""


def check(plan: Checkable, certificate: Certificate | None = None) -> Report:
    """Recompute a plan and list every violation.

    Parameters
    ----------
    plan
        Flights, set-points, or both. Of a result the promises are checked too: that the
        objective is what the plan costs or yields, and that the bound does bound it.
    certificate
        A proof of the bound on the flights, to be verified too; see
        :func:`windopt.planning.certification.certify`.

    Raises
    ------
    InvalidInput
        If a certificate comes with a plan of which no bound is claimed.
    """
    if certificate is not None:
        report = check(plan)
        proof = _check_proof(plan, certificate) if report.passed else UNTOUCHED
        return report + proof.about("certificate")
    if isinstance(plan, Plan):
        return _check_steps(plan)
    if isinstance(plan, Result):
        return _check_result(plan)
    if isinstance(plan, InspectionPlan):
        return check_inspection(plan)
    require_kind("plan", plan, YawPlan)
    return check_yaw(plan)


def _check_proof(plan: Checkable, certificate: Certificate) -> Report:
    from windopt.checking.certificate import check_certificate  # numba, only where there is one

    result = plan.inspection if isinstance(plan, Plan) else plan
    flights = result.solution if isinstance(result, Result) else None
    if not (isinstance(result, Result) and isinstance(flights, InspectionPlan)):
        got = type(flights or result).__name__
        raise InvalidInput("certificate", "to come with flights and the bound on them", got)
    return check_certificate(flights, result.bound, certificate)


def _check_result(result: Result[Any]) -> Report:
    if result.solution is None:
        return Report((f"there is no plan to check: {result.reason or result.sentence}",))
    return check(result.solution) + Report(tuple(_promises(result)))


def _promises(result: Result[Any]) -> Iterator[str]:
    """Objective, bound and status, against the plan and each other."""
    plan = result.found()
    flights = isinstance(plan, InspectionPlan)
    value = plan.cost if flights else plan.power
    if not isclose(result.objective, value, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
        yield f"the objective is said to be {result.objective:.9g}, the plan's is {value:.9g}"
    slack = TOLERANCE * max(1.0, abs(value))
    overstated = result.bound - value if flights else value - result.bound
    if isnan(result.bound) or overstated > slack:
        yield f"the bound of {result.bound:.9g} does not bound the objective of {value:.9g}"
    possible = power_to_beat(plan) if isinstance(plan, YawPlan) else -inf
    if result.bound < possible * (1 - TOLERANCE):
        yield f"the bound of {result.bound:.9g} W is below the {possible:.9g} W possible"
    if not result.asked_gap >= 0:
        yield f"a gap of {result.asked_gap:.3g} cannot have been asked for"
    if result.status is Status.OPTIMAL:
        yield from _proof(result)
    if result.status in {Status.INFEASIBLE, Status.NO_SOLUTION}:
        yield f"there is a plan, but the status is {result.status}"


def _proof(result: Result[Any]) -> Iterator[str]:
    """Whether objective and bound meet, as far as was asked."""
    if not isfinite(result.bound):
        yield "the plan is called optimal without a bound"
        return
    scale = max(abs(result.objective), abs(result.bound))
    if abs(result.objective - result.bound) > (result.asked_gap + TOLERANCE) * scale:
        asked = f"asked was one of {result.asked_gap:.3g}"
        yield f"the plan is called optimal at a gap of {result.gap:.3g}, {asked}"


def _check_steps(plan: Plan) -> Report:
    """Check the whole answer: set-points for each step of the forecast, and the flights."""
    report = _check_result(plan.inspection).about("inspection")
    if len(plan.yaw) != len(plan.forecast):
        sentence = f"{len(plan.yaw)} yaw steps for {len(plan.forecast)} steps of the forecast"
        report += Report((sentence,))
    times = [plan.forecast.issued, *plan.forecast.time]
    for earlier, later in pairwise(times):
        if not later > earlier:
            report += Report((f"the forecast's time {later} is not after {earlier}",))
    for time, wind, yaw in zip(plan.forecast.time, plan.forecast.winds, plan.yaw, strict=False):
        report += _check_result(yaw).about(f"yaw at {time}")
        if yaw.solution and not _same(yaw.solution.wind.velocity, wind.velocity):
            report += Report((f"yaw at {time}: the wind is not that of the forecast",))
    report += Report(tuple(too_fast(plan)))
    flown = plan.inspection.solution
    if flown and not _same(flown.wind.velocity, plan.forecast.mean.velocity):
        report += Report(("inspection: the wind is not the forecast's mean",))
    return report


def _same(one: Any, other: Any) -> bool:
    return all(isclose(a, b, rel_tol=1e-9, abs_tol=1e-9) for a, b in zip(one, other, strict=True))
