"""Plans in short: the tables and sentences that a command prints."""

from collections.abc import Iterable
from math import degrees, isfinite

from rich.markup import escape
from rich.table import Table

from windopt.cli.terminal import counted, out, percent, say
from windopt.domain.plan import InspectionPlan, LeftOut, Plan, Unreachable, YawPlan
from windopt.errors import listed
from windopt.planning.coverage import Coverage, coverage
from windopt.result import Result

FEW = 5
"""Reasons to tell one by one."""


def show_plan(plan: Plan) -> None:
    """Print a plan: the forecast with the farm's power at each step, then the flights."""
    title = f"Forecast by {plan.forecast.method}, issued {plan.time}"
    table = Table("time", "wind (m/s)", "from (deg)", "nacelles (deg)", "power (MW)", title=title)
    steps = zip(plan.forecast.time, plan.forecast.winds, plan.yaw, strict=True)
    for time, wind, yaw in steps:
        set_points = yaw.found()
        row = f"{wind.speed:.2f}", f"{degrees(wind.theta_met):.1f}", facing(set_points)
        table.add_row(str(time), *row, f"{set_points.power / 1e6:.2f}")
    out.print(table)
    show_inspection(plan.inspection)


def facing(plan: YawPlan) -> str:
    """Return where the nacelles face [deg], from the first to the last clockwise."""
    clockwise = sorted(plan.set_points, key=lambda point: -point.misalignment)
    first, last = (f"{degrees(point.nacelle):.1f}" for point in (clockwise[0], clockwise[-1]))
    return first if first == last else f"{first} to {last}"


def show_inspection(result: Result[InspectionPlan]) -> None:
    """Print a plan's flights, what is out of reach or left out, and what is proved."""
    plan = result.solution
    if plan is None:
        say(f"No plan: {result.sentence} {result.reason}")
        return
    if plan.flights:
        out.print(_flights(plan))
    _tell("Unreachable", plan.unreachable)
    if len(plan.unreachable) == len(plan.farm):
        say(f"No flights. {result.reason}")
        return
    _tell("Left out", plan.left_out)
    flights = counted(len(plan.flights), "flight")
    say(f"{flights}, {plan.duration:.2f} s ({plan.duration / 60:.2f} min).")
    covered = coverage(result)
    if covered is not None:
        say(_covered(covered))
    elif plan.left_out:
        worth = f"worth {plan.forgone:.2f} s; with the flights that makes {plan.cost:.2f} s"
        say(f"{counted(len(plan.left_out), 'turbine')} left out, {worth}.")
    say(f"{result.sentence} {_proof(result, covered)} {result.reason}".strip())


def _tell(what: str, turbines: Iterable[Unreachable | LeftOut]) -> None:
    """Print why turbines are not inspected, those of one reason together."""
    reasons: dict[str, list[str]] = {}
    for each in turbines:
        reasons.setdefault(each.reason, []).append(each.turbine)
    told = list(reasons.items())
    for reason, names in told[:FEW]:
        say(f"{what}: {', '.join(names)}. {reason}")
    if others := [name for _, names in told[FEW:] for name in names]:
        say(f"{what}: {', '.join(others)}, for reasons of their own, which --json tells.")


def _flights(plan: InspectionPlan) -> Table:
    table = Table("station", "turbines", "min", title=f"Inspection of {plan.farm.name}")
    table.columns[2].justify = "right"
    for flight in plan.flights:
        stops = " > ".join(escape(name) for name in flight.turbines)
        table.add_row(escape(flight.station), stops, f"{flight.duration / 60:.2f}")
    return table


def _covered(covered: Coverage) -> str:
    """Say how much is inspected, and how much can be."""
    if covered.inspected == covered.of:
        return f"All {covered.of} turbines within reach are inspected."
    inspected = f"{covered.inspected} of {covered.of} turbines within reach are inspected"
    beaten = "" if covered.most == covered.priority else f" than {covered.most}"
    if not covered.weighted:
        return f"{inspected}; no plan inspects more{beaten}."
    reached = f"a sum of priorities of {covered.priority} of {covered.total}"
    return f"{inspected}, {reached}; no plan reaches more{beaten}."


def _proof(result: Result[InspectionPlan], covered: Coverage | None) -> str:
    """Say what is proved of the time of all flights, where it is settled what they inspect."""
    if not isfinite(result.bound):
        return "There is no bound."
    if covered is not None and covered.most > covered.priority:
        return f"{result.runtime:.1f} s."
    settled = 0.0 if covered is None else covered.forgone
    objective, bound = result.objective - settled, result.bound - settled
    gap = (objective - bound) / objective if objective else 0.0
    source = f" ({result.bound_source})" if result.bound_source else ""
    told = "Bound" if covered is None else "No plan that inspects as much takes less than"
    return f"{told} {bound:.2f} s{source}, gap {percent(gap)}, {result.runtime:.1f} s."


def show_yaw(result: Result[YawPlan]) -> None:
    """Print a plan's set-points, turbines of equal set-points together."""
    plan = result.found()
    columns = "turbines", "nacelle (deg)", "misalignment (deg)", "pitch (deg)", "power (MW)"
    table = Table(*(c for c in columns if plan.steering is None or not c.startswith("pitch")))
    for row, names in _alike(plan).items():
        table.add_row(escape(listed(names, 4)), *row)
    out.print(table)
    gained = f" ({plan.gain:+.2%})" if plan.steering else ""
    say(
        f"{plan.farm.name}: {plan.power / 1e6:.3f} MW{gained} in {plan.wind.speed:.2f} m/s; "
        f"facing the wind {plan.power_baseline / 1e6:.3f} MW."
    )
    if plan.steering and isfinite(result.bound):
        bound = f"Bound {result.bound / 1e6:.3f} MW ({result.bound_source})"
        say(f"{bound}, gap {percent(result.gap)}.")
    say(f"{result.sentence} {result.reason}".strip())


def _alike(plan: YawPlan) -> dict[tuple[str, ...], list[str]]:
    """Group turbines by what their set-points look like in print."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for point in plan.set_points:
        angles = (point.nacelle, point.misalignment, point.pitch)
        shown = (f"{degrees(angle):.2f}" for angle in angles if angle is not None)
        groups.setdefault((*shown, f"{point.power / 1e6:.4f}"), []).append(point.turbine)
    return groups
