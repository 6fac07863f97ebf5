"""``windopt stations``: where to put the UAVs."""

from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.table import Table

from windopt.cli import options as opt
from windopt.cli.checked import checked, one_of
from windopt.cli.flight_options import UavOptions
from windopt.cli.outcome import exit_code
from windopt.cli.terminal import counted, note, progress, say
from windopt.cli.terminal import out as console
from windopt.cli.unfolded import unfolded
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.io.plans import json_text
from windopt.io.station_records import placement_record
from windopt.io.stations import write_stations
from windopt.io.whole_files import require_absent
from windopt.planning.station_comparison import Placement, k_means_beside, placement
from windopt.planning.station_design import MARGIN, station_design
from windopt.planning.station_sites import CANDIDATES, DEFAULT_CANDIDATES
from windopt.planning.stations import METHODS, placed_by_cover, placed_by_k_means
from windopt.result import Result

Count = Annotated[
    int | None,
    typer.Option(
        "--stations", metavar="N", help="How many; by default as few as reach every turbine."
    ),
]
Margin = Annotated[float, typer.Option(help="Share of a flight kept in reserve.")]
Candidates = Annotated[
    str,
    typer.Option(
        callback=checked(one_of(CANDIDATES)),
        help=f"Where stations may be: one of {', '.join(CANDIDATES)}.",
    ),
]
Method = Annotated[
    str,
    typer.Option(callback=checked(one_of(METHODS)), help=f"One of {', '.join(METHODS)}."),
]
File = Annotated[
    Path | None, typer.Option(metavar="FILE", help="CSV file for inspect and plan --stations.")
]


@unfolded
def stations(
    farm: opt.FarmName,
    count: Count = None,
    dwell: opt.Dwell = 0.0,
    margin: Margin = MARGIN,
    candidates: Candidates = DEFAULT_CANDIDATES,
    method: Method = METHODS[0],
    time_limit: opt.TimeLimit = 60.0,
    seed: opt.Seed = 0,
    *,
    uav: UavOptions,
    json: opt.Json = False,
    out: File = None,
    force: opt.Force = False,
) -> None:
    """Find the fewest stations that reach every turbine, and of as many the quickest."""
    if out is not None:
        require_absent(out, force=force)
    site = Farm.load(farm)
    note(site.notes)
    design = station_design(site, uav=uav.uav, dwell=dwell, margin=margin)
    with progress(f"Placing stations for {site.name} by {method}"):
        if method == "k-means":
            result = placed_by_k_means(design, count, seed=seed)
        else:
            result = placed_by_cover(
                design, count, candidates=candidates, time_limit=time_limit, seed=seed
            )
        placed = None if result.solution is None else placement(method, result.solution, design)
        alike = placed is not None and method == "cover"
        beside = k_means_beside(design, len(result.found()), seed=seed) if alike else ()
    if json:
        typer.echo(json_text(placement_record(result, placed, beside)), nl=False)
    else:
        _show(site.name, result, placed, beside)
    if out is not None and result.solution is not None:
        note((f"Written to {write_stations(result.solution, out, force=force)}.",))
    raise typer.Exit(exit_code(result))


def _show(
    farm: str, result: Result[Fleet], placed: Placement | None, beside: Sequence[Placement]
) -> None:
    """Print the stations of a farm, what proves them and what k-means achieves."""
    if placed is None:
        say(f"No stations: {result.sentence} {result.reason}")
        return
    table = Table("station", "x (m)", "y (m)", "turbines", title=f"Stations for {escape(farm)}")
    for column in table.columns[1:]:
        column.justify = "right"
    for station, turbines in zip(placed.fleet.stations, placed.turbines, strict=True):
        table.add_row(escape(station.name), f"{station.x:.1f}", f"{station.y:.1f}", str(turbines))
    console.print(table)
    for each in (placed, *beside):
        say(f"{each.method}: {_achieved(each)}")
    say(f"{_proof(result)} {result.reason}".strip())


def _achieved(placed: Placement) -> str:
    beyond = f", {counted(placed.beyond, 'turbine')} beyond reach" if placed.beyond else ""
    return (
        f"{counted(len(placed.fleet), 'station')}, round trips of {placed.time / 60:.1f} min in "
        f"all and {placed.longest / 60:.1f} min at most{beyond}."
    )


def _proof(result: Result[Fleet]) -> str:
    if not isfinite(result.bound):
        return f"{result.sentence} There is no bound."
    return (
        f"{result.sentence} Objective {result.objective:g}, bound {result.bound:g} "
        f"({result.bound_source}), {result.runtime:.1f} s."
    )
