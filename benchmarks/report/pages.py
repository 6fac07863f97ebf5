"""The pages of the documentation that lines are made into, one or more for each problem."""

import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from benchmarks.case import Record
from benchmarks.registry import problem
from benchmarks.report import forecast_tables, rst, yaw_tables
from benchmarks.report.cluster import cluster_page
from benchmarks.report.lines import all_lines, failures, runs
from benchmarks.report.paper_tables import TABLES
from benchmarks.report.routing_pages import cases_page, farms_page, growth_page, routing_page
from windopt.io.whole_files import write_whole

FIGURE = re.compile(r"^\.\. figure:: (\S+)$", re.MULTILINE)
MADE = "made.txt"
"""Names the files that were made, so that the next run can remove what it no longer makes."""


def write_pages(lines: Path, out: Path) -> list[Path]:
    """Make the pages of all lines of a folder, and return them.

    Pages and pictures of an earlier run that these lines do not make are removed, other files not.
    """
    out.mkdir(parents=True, exist_ok=True)
    written, records = [], all_lines(lines)
    made: set[str] = set()
    for name, make in PAGES.items():
        text = "\n".join(make(records, out))
        if text:
            path = out / f"{name}.rst"
            write_whole(path, text, force=True)
            written.append(path)
            made |= {path.name, *FIGURE.findall(text)}
    _remove_others(made, out)
    return written


def _remove_others(made: set[str], out: Path) -> None:
    """Remove what an earlier run made and this one did not, and keep the names of what it did."""
    told = out / MADE
    earlier = told.read_text(encoding="utf-8").split() if told.exists() else []
    for name in {*earlier} - made:
        (out / name).unlink(missing_ok=True)
    write_whole(told, "\n".join(sorted(made)), force=True)


def yaw_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of farms steered by their wakes."""
    mine = [record for record in records if record["problem"] == "yaw"]
    if not mine:
        return
    yaw = problem("yaw")
    yield rst.title("Farms steered by their wakes, beside rivals")
    yield YAW
    for caption, rows in yaw_tables.tables(mine).items():
        yield rst.table(caption, rows)
    absent = yaw_tables.not_measured(mine, yaw.instances("full"), yaw.methods("full"))
    yield rst.filled("Cases of the full set that were not measured", absent)
    yield rst.origin(mine)


def yaw_cases_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page with windopt's methods beside FLORIS, instance by instance."""
    mine = [record for record in records if record["problem"] == "yaw"]
    if not (tables := yaw_tables.case_tables(mine)):
        return
    yield rst.title("Steered farms, case by case")
    yield YAW_CASES
    for caption, rows in tables.items():
        yield rst.table(caption, rows)


def forecast_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of forecasts, and of the networks that make them on small machines."""
    mine = [record for record in records if record["problem"] in {"forecast", "edge"}]
    if len(rows := forecast_tables.forecasters(records)) == 1:
        return
    yield rst.title("Forecasts of the wind, by bits")
    yield FORECAST
    yield rst.table("Errors over all steps ahead, on the last third of the series", rows)
    yield rst.filled("One window on a small machine", forecast_tables.networks(mine))
    yield rst.filled("Cases that failed", failures(mine))
    yield rst.origin([*forecast_tables.scored(records).values()])


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
    yield rst.filled("Rows that failed", failures(mine))
    yield rst.origin(mine)


def runs_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page of what was run: commands, limits, times and machines."""
    if records:
        yield rst.title("What was run")
        yield RUNS
        yield rst.table("Commands behind the lines", runs(records))


YAW = """\
windopt's nonlinear program and serial refine, and the paper's Algorithm 1, which knows of no
wakes, beside three rivals: the serial refine of FLORIS with its defaults, FLORIS's SLSQP
(``YawOptimizationScipy``) with its defaults, and SLSQP as a user of scipy would write it on
windopt's exact wakes, from 5 degrees to either side. FLORIS itself judges all set-points; a gain
is the share by which they deliver more than rotors that face the wind, the mean over the winds of
an instance. One gain is a point above another if the farm delivers 1 % more of its power facing
the wind.

SLSQP on windopt's wakes is the rival to watch: it gains about as much as the nonlinear program,
in more time, and where it gains more the third table says so. FLORIS's own asks for one farm
power at a time; it was measured on five small instances only, and took 12 to 216 s on those of 25
turbines. None of these searches proves that its set-points are the best.

Seconds are of the processor, from the farm and the wind to the set-points, in one process; what
does not depend on the farm was compiled and imported before. Methods were measured in several runs,
with other work on the machine, so ratios are rough; the commands are below. The nonlinear program
proves its bound within its time. Serial refine is timed without the bound that
:func:`windopt.plan_yaw` adds to it. ``grid5x5-5D-272`` is 25 turbines 5 diameters apart in 8 m/s
from 272 degrees. A ``table`` has set-points for each of 72 directions; ``robust`` is one set-point
in a scatter of 3 degrees; ``steps`` are twelve between which a nacelle turns by 3 degrees at most,
to which all but the nonlinear program are clipped afterwards.
:doc:`/benchmarks/generated/yaw-cases` has windopt's methods and FLORIS's case by case.
"""

YAW_CASES = """\
Gains and times are those of :doc:`/benchmarks/generated/yaw`. No set-points deliver more than the
bound, the least that any method of windopt proved for the instance; how much of the distance to it
is the bound's own, nobody knows.
"""

FORECAST = """\
Each forecaster is fitted to the first two thirds of a month of a weather model every 10 minutes,
and scored on windows of the last third. ``lstm-4`` is the network with weights of 4 bits,
``lstm-raw-4`` with the paper's own target, and ``hour-ahead`` forecasts know hourly means only.
Persistence, which says that the wind stays as it is, stands beside the networks.
:doc:`/explanation/quantisation` says what bits buy on other series and on small machines;
:doc:`/benchmarks/generated/paper` has the paper's figures beside these.
"""

PAPER = """\
The paper's data set is not public, and neither are its coordinates; ours are others. ``python -m
benchmarks run paper`` prints the same tables.
"""

DIFFERENCES = """\
Forecasts: the series is a month of a weather model every 10 minutes, smoother than the paper's
measurements every 5, so every error is smaller; persistence, which the paper does not show,
stands beside the networks. All methods are scored on the same windows of 12 hours.

Yaw: ours is a closed loop over the day on which the wind turned most. The loss by hourly means is
far below the paper's, since its hour has an error of 39 degrees where ours stays within a few; by
the cosine cubed its 44 kWh would need an error of 46 degrees. The energy is of a turbine of the
paper's make in our wind, so only the ratios compare.

Routing: with the coordinates that were fitted to them both rows come out, and the exact method
proves that Algorithm 2's plan is the best. On the coordinates of the real Walney the same
turbines are farther apart, so the paper's flights would outlast the battery.
"""

RUNS = """\
Each command with its cases, the wall time and the processor time of all of them one after the
other, and where it ran. Lines that were measured anew count with their last run.
"""

PAGES: dict[str, Callable[[Sequence[Record], Path], Iterator[str]]] = {
    "routing": routing_page,
    "routing-farms": farms_page,
    "routing-cases": cases_page,
    "growth": growth_page,
    "cluster": cluster_page,
    "yaw": yaw_page,
    "yaw-cases": yaw_cases_page,
    "forecast": forecast_page,
    "paper": paper_page,
    "runs": runs_page,
}
"""Pages by file name; each takes all lines and the folder for its pictures."""
