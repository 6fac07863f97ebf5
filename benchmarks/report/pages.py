"""The pages of the documentation that lines are made into, one for each problem."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from benchmarks.case import Record
from benchmarks.inspections import NAME
from benchmarks.records import read_lines
from benchmarks.registry import problem
from benchmarks.report import plots, rst, yaw_tables
from benchmarks.report.cluster import cluster_page
from benchmarks.report.paper_tables import TABLES
from benchmarks.report.routing_tables import (
    by_instance,
    by_method,
    failures,
    relaxations,
    settings,
)
from windopt.io.whole_files import write_whole

GRID = "grid"


def write_pages(lines: Path, out: Path) -> list[Path]:
    """Make the pages of all lines of a folder, and return them."""
    out.mkdir(parents=True, exist_ok=True)
    written = []
    for name, make in PAGES.items():
        text = "\n".join(make(_read(lines), out))
        if text:
            path = out / f"{name}.rst"
            write_whole(path, text, force=True)
            written.append(path)
    return written


def _read(lines: Path) -> list[Record]:
    return [record for file in sorted(lines.glob("*.jsonl")) for record in read_lines(file)]


def routing_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of inspection routing on real farms."""
    mine = [r for r in records if r["problem"] == "routing" and not r["instance"].startswith(GRID)]
    if not mine:
        return
    yield rst.title("Inspection flights of real farms")
    yield ROUTING
    for (limit,), group in sorted(settings(mine, lambda r: (r["time_limit"],)).items()):
        yield rst.title(f"With {limit:g} s for each answer", "-")
        yield rst.table("Methods", by_method(group))
        for kind, draw in (
            ("profile", plots.profile),
            ("distances", plots.distances),
            ("gaps", plots.gap_over_time),
        ):
            yield _picture(draw, group, out / f"routing-{kind}-{limit:g}.png")
        if len(bounds := relaxations(group)) > 1:
            yield rst.table("Linear relaxations, in per cent of the best plan known", bounds)
        for (speed, direction, dwell), same in sorted(settings(group, _setting).items()):
            wind = f"{speed:g} m/s from {direction:g} deg" if speed else "No wind"
            yield rst.table(f"{wind}, {dwell:g} s at each turbine", by_instance(same))
        if len(failed := failures(group)) > 1:
            yield rst.table("Cases that failed", failed)
        yield rst.title("Where the lines come from", "~")
        yield rst.origin(group)


def _setting(record: Record) -> tuple[float, ...]:
    """Return wind and dwell, which a failed case says by its name only."""
    parts = NAME.fullmatch(record["instance"])
    return tuple(float(parts[name]) for name in ("speed", "direction", "dwell")) if parts else ()


def growth_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page on how times grow with the number of turbines."""
    grids = [r for r in records if r["problem"] == "routing" and r["instance"].startswith(GRID)]
    if not grids:
        return
    yield rst.title("How times grow with the farm")
    yield GROWTH
    yield _picture(plots.growth, grids, out / "growth.png")
    yield rst.table("Square grids, 1 km between neighbours", by_instance(grids))
    yield rst.title("Where the lines come from", "~")
    yield rst.origin(grids)


def yaw_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of farms steered by their wakes."""
    mine = [record for record in records if record["problem"] == "yaw"]
    if not mine:
        return
    yield rst.title("Farms steered by their wakes, beside FLORIS")
    yield YAW
    for caption, rows in yaw_tables.tables(mine).items():
        yield rst.table(caption, rows)
    if len(absent := yaw_tables.not_measured(mine, problem("yaw").instances("full"))) > 1:
        yield rst.table("Cases of the full set that were not measured", absent)
    yield rst.title("Where the lines come from", "~")
    yield rst.origin(mine)


def paper_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page with the paper's four tables."""
    mine = [record for record in records if record["problem"] == "paper"]
    if not mine:
        return
    yield rst.title("The paper's tables, ours beside its own")
    yield PAPER
    for caption, make in TABLES.items():
        yield rst.table(caption, make(mine))
    yield DIFFERENCES
    if len(failed := failures(mine)) > 1:
        yield rst.table("Rows that failed", failed)
    yield rst.title("Where the lines come from", "~")
    yield rst.origin(mine)


def _picture(draw: Callable[..., object], records: Sequence[Record], path: Path) -> str:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4), layout="constrained")
    draw(records, figure.subplots())
    figure.savefig(path, dpi=110, metadata={"Software": None})
    return rst.picture(path.name, (draw.__doc__ or "").splitlines()[0].removeprefix("Draw "))


ROUTING = """\
Every answer has passed the independent checker. Plans are measured by the best bound that any
method proved for the instance, so 0 % is optimal whoever found it; "proved" means that the method
itself proved its plan. A farm has n turbines and K stations. PyVRP and OR-tools use all of their
time and prove nothing. :doc:`/benchmarks/protocol` says how this was measured.
"""

YAW = """\
The nonlinear program and serial refine, both windopt's, beside the serial refine of FLORIS with its
defaults. FLORIS itself judges all set-points; a gain is the share by which they deliver more than
rotors that face the wind, the mean over the winds of an instance. One gain is a point above another
if the farm delivers 1 % more of its power facing the wind. No set-points deliver more than the
bound, which is windopt's; how much of the distance to it is the bound's own, nobody knows.

Seconds are of the processor, from the farm and the wind to the set-points, in one process, the
methods of an instance one after the other; what does not depend on the farm was compiled and
imported before. ``grid5x5-5D-272`` is 25 turbines 5 diameters apart in 8 m/s from 272 degrees. A
``table`` has set-points for each of 72 directions; ``robust`` is one set-point in a scatter of 3
degrees; ``steps`` are twelve between which a nacelle turns by 3 degrees at most, to which serial
refine is clipped afterwards.
"""

PAPER = """\
The paper's data set is not public, and neither are its coordinates; ours are others.
``python -m benchmarks run paper`` prints the same tables.
"""

DIFFERENCES = """\
Forecasts: the series is a month of a weather model every 10 minutes, smoother than the paper's
measurements every 5, so every error is smaller; persistence, which the paper does not show, stands
beside the networks. All methods are scored on the same windows of 12 hours.

Yaw: ours is a closed loop over the day on which the wind turned most. The loss by hourly means is
far below the paper's, since its hour has an error of 39 degrees where ours stays within a few; by
the cosine cubed its 44 kWh would need an error of 46 degrees. The energy is of a turbine of the
paper's make in our wind, so only the ratios compare.

Routing: with the coordinates that were fitted to them both rows come out, and the exact method
proves that Algorithm 2's plan is the best. On the coordinates of the real Walney the same turbines
are farther apart, so the paper's flights would outlast the battery.
"""

GROWTH = """\
Turbines in a square grid, one wind, stations by the same rule: only the number changes. Full
circles are proved, open ones are not.
"""

PAGES: dict[str, Callable[[Sequence[Record], Path], Iterator[str]]] = {
    "routing": routing_page,
    "growth": growth_page,
    "cluster": cluster_page,
    "yaw": yaw_page,
    "paper": paper_page,
}
"""Pages by file name; each takes all lines and the folder for its pictures."""
