"""What a person sees: complaints, progress and tables, on a terminal only where they belong."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import degrees, isfinite

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from windopt.domain.plan import InspectionPlan, Plan, YawPlan
from windopt.result import Result

out = Console(highlight=False, soft_wrap=True, emoji=False)
err = Console(stderr=True, highlight=False, soft_wrap=True, emoji=False)


def say(sentence: str) -> None:
    """Print a sentence."""
    out.print(escape(sentence))


def complain(sentence: str) -> None:
    """Print a sentence where complaints go."""
    err.print(escape(sentence), style="red")


def note(sentences: tuple[str, ...]) -> None:
    """Print what a reader assumed or found, where complaints go."""
    for sentence in sentences:
        err.print(escape(sentence), style="dim")


def counted(number: int, thing: str) -> str:
    """Return a number of things in words: 1 flight, 2 flights."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


@contextmanager
def progress(task: str) -> Iterator[Callable[[float, float], None]]:
    """Show a task with its objective and bound [s] while it runs; silent off a terminal."""
    if not err.is_terminal:
        yield lambda objective, bound: None
        return
    with err.status(task) as status:

        def update(objective: float, bound: float) -> None:
            gap = (objective - bound) / objective if isfinite(objective) and objective else None
            told = "" if gap is None or not isfinite(gap) else f", gap {gap:.2%}"
            status.update(f"{task}: plan {objective:.1f} s, bound {bound:.1f} s{told}")

        yield update


@contextmanager
def counter(task: str) -> Iterator[Callable[[int, int], None]]:
    """Show how much of a task is done while it runs; silent off a terminal."""
    if not err.is_terminal:
        yield lambda done, of: None
        return
    with err.status(task) as status:
        yield lambda done, of: status.update(f"{task}: {done} of {of}")


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
    """Print a plan's flights, and what is out of reach or left out."""
    plan = result.solution
    if plan is None:
        say(f"No plan: {result.status.sentence} {result.reason}")
        return
    if plan.flights:
        out.print(_flights(plan))
    reasons: dict[str, list[str]] = {}
    for left_out in plan.unreachable:
        reasons.setdefault(left_out.reason, []).append(left_out.turbine)
    for reason, names in reasons.items():
        say(f"Unreachable: {', '.join(names)}. {reason}")
    if len(plan.unreachable) == len(plan.farm):
        say(f"No flights. {result.reason}")
        return
    for left in plan.left_out:
        say(f"Left out: {left.turbine}. {left.reason}")
    flights = counted(len(plan.flights), "flight")
    say(f"{flights}, {plan.duration:.2f} s ({plan.duration / 60:.2f} min).")
    if plan.worth is not None:
        worth = f"worth {plan.forgone:.2f} s; with the flights that makes {plan.cost:.2f} s"
        say(f"{counted(len(plan.left_out), 'turbine')} left out, {worth}.")
    say(f"{_proof(result)} {result.reason}".strip())


def _flights(plan: InspectionPlan) -> Table:
    table = Table("station", "turbines", "min", title=f"Inspection of {plan.farm.name}")
    table.columns[2].justify = "right"
    for flight in plan.flights:
        stops = " > ".join(escape(name) for name in flight.turbines)
        table.add_row(escape(flight.station), stops, f"{flight.duration / 60:.2f}")
    return table


def _proof(result: Result[InspectionPlan]) -> str:
    if not isfinite(result.bound):
        return f"{result.status.sentence} There is no bound."
    source = f" ({result.bound_source})" if result.bound_source else ""
    return (
        f"{result.status.sentence} Bound {result.bound:.2f} s{source}, gap {result.gap:.2%}, "
        f"{result.runtime:.1f} s."
    )


def show_yaw(result: Result[YawPlan]) -> None:
    """Print a plan's set-points, turbines of equal set-points together."""
    plan = result.found()
    columns = "turbines", "nacelle (deg)", "misalignment (deg)", "pitch (deg)", "power (MW)"
    table = Table(*(c for c in columns if plan.steering is None or not c.startswith("pitch")))
    for row, names in _alike(plan).items():
        told = ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
        table.add_row(escape(told), *row)
    out.print(table)
    gained = f" ({plan.gain:+.2%})" if plan.steering else ""
    say(
        f"{plan.farm.name}: {plan.power / 1e6:.3f} MW{gained} in {plan.wind.speed:.2f} m/s; "
        f"facing the wind {plan.power_baseline / 1e6:.3f} MW."
    )
    if plan.steering and isfinite(result.bound):
        say(f"Bound {result.bound / 1e6:.3f} MW ({result.bound_source}), gap {result.gap:.2%}.")
    say(f"{result.status.sentence} {result.reason}".strip())


def _alike(plan: YawPlan) -> dict[tuple[str, ...], list[str]]:
    """Group turbines by what their set-points look like in print."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for point in plan.set_points:
        angles = (point.nacelle, point.misalignment, point.pitch)
        shown = (f"{degrees(angle):.2f}" for angle in angles if angle is not None)
        groups.setdefault((*shown, f"{point.power / 1e6:.4f}"), []).append(point.turbine)
    return groups
