"""How many turbines a plan inspects, and any plan can, where as many as possible come first."""

from dataclasses import dataclass
from math import floor, isfinite

from windopt.domain.plan import InspectionPlan
from windopt.planning.worth import unit_of_priority
from windopt.result import Result


@dataclass(frozen=True)
class Coverage:
    """How much of what is within reach a plan inspects.

    Parameters
    ----------
    inspected, of
        Turbines, by the plan and in all.
    priority, total
        Sums of their priorities.
    most
        Sum of priorities that no plan exceeds.
    forgone
        What is left out, as the objective counts it [s].
    """

    inspected: int
    of: int
    priority: int
    total: int
    most: int
    forgone: float

    @property
    def weighted(self) -> bool:
        """Whether a turbine has a priority above 1."""
        return self.total > self.of


def coverage(result: Result[InspectionPlan]) -> Coverage | None:
    """Return what a plan covers; None where worths are not priorities.

    A unit of priority is worth more than all flights together last: every plan leaves out as many
    as the bound has whole units.
    """
    plan = result.found()
    if plan.worth is None:
        return None
    unit = unit_of_priority(plan.fleet, len(plan.farm))
    if any(worth % unit or not worth for worth in plan.worth):
        return None
    worths = zip(plan.farm.names, plan.worth, strict=True)
    beyond = {unreachable.turbine for unreachable in plan.unreachable}
    priority = {name: round(worth / unit) for name, worth in worths if name not in beyond}
    total = sum(priority.values())
    return Coverage(
        inspected=len(priority) - len(plan.left_out),
        of=len(priority),
        priority=total - sum(priority[left.turbine] for left in plan.left_out),
        total=total,
        most=total - (floor(result.bound / unit) if isfinite(result.bound) else 0),
        forgone=plan.forgone,
    )
