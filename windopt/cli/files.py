"""What a command leaves in its folder: the record, the map and the pictures."""

from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from windopt.cli.terminal import note
from windopt.domain.plan import InspectionPlan, Plan, YawPlan
from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput, MissingExtra
from windopt.io.geojson import write_geojson
from windopt.io.plan_reader import Recorded
from windopt.io.plans import write_plan
from windopt.io.whole_files import write_whole
from windopt.plotting import (
    axes,
    plot_facing_wakes,
    plot_flights,
    plot_forecast,
    plot_wakes,
    plot_yaw,
)
from windopt.result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Picture = Callable[["Axes"], "Axes"]
Named = tuple[str, Picture]


FILES = (
    "plan.json",
    "certificate.json",
    "flights.geojson",
    "forecast.png",
    "flights.png",
    "yaw.png",
    "wakes.png",
    "wakes-before.png",
)


def require_free(folder: Path | None, *, force: bool) -> None:
    """Refuse a folder that holds files which would be overwritten.

    Raises
    ------
    InvalidInput
        If it does and ``force`` is not given, or if it is a file.
    """
    if folder is None:
        return
    for each in (folder, *folder.parents):
        if each.exists() and not each.is_dir():
            raise InvalidInput("--out", "to be a folder", f"the file {each}")
    there = [name for name in FILES if (folder / name).exists()]
    if there and not force:
        raise InvalidInput("--out", "to be a folder without them, or --force", ", ".join(there))


def write_folder(
    plan: Recorded, folder: Path, *, force: bool, series: WindSeries | None = None
) -> None:
    """Write plan.json, flights.geojson and pictures into ``folder``, each whole or not at all.

    Raises
    ------
    InvalidInput
        If a file is already there and ``force`` is not given; then nothing is written.
    """
    require_free(folder, force=force)
    folder.mkdir(parents=True, exist_ok=True)
    write_plan(plan, folder / "plan.json", force=force)
    written = ["plan.json"]
    if (flights := _flights(plan)) is not None:
        written += _map(flights, folder / "flights.geojson", force=force)
    written += _draw(dict(_pictures(plan, series)), folder, force=force)
    note((f"Written to {folder}: {', '.join(written)}.",))


def _flights(plan: Recorded) -> InspectionPlan | None:
    result = plan.inspection if isinstance(plan, Plan) else plan
    return result.solution if isinstance(result.solution, InspectionPlan) else None


def _map(plan: InspectionPlan, path: Path, *, force: bool) -> list[str]:
    if plan.farm.crs is None:
        note(("The farm has no CRS, so its flights have no longitude and latitude.",))
        return []
    write_geojson(plan, path, force=force)
    return [path.name]


def _pictures(plan: Recorded, series: WindSeries | None) -> Iterator[Named]:
    """Yield the pictures of a plan by file name."""
    if isinstance(plan, Plan):
        if series is not None:
            yield "forecast.png", lambda ax: plot_forecast(series, plan.forecast, ax)
        yield from _result_pictures(plan.yaw[0])
        yield from _result_pictures(plan.inspection)
    else:
        yield from _result_pictures(plan)


def _result_pictures(result: Result[InspectionPlan] | Result[YawPlan]) -> Iterator[Named]:
    match result.solution:
        case InspectionPlan() as flights:
            yield "flights.png", lambda ax: plot_flights(flights, ax)
        case YawPlan() as set_points:
            yield "yaw.png", lambda ax: plot_yaw(set_points, ax)
            if set_points.steering is not None:
                yield "wakes.png", lambda ax: plot_wakes(set_points, ax)
                yield "wakes-before.png", lambda ax: plot_facing_wakes(set_points, ax)


def _draw(pictures: dict[str, Picture], folder: Path, *, force: bool) -> list[str]:
    """Draw the pictures, or say what they need."""
    try:
        drawn = {name: _png(draw(axes())) for name, draw in pictures.items()}
    except MissingExtra as missing:
        note((str(missing),))
        return []
    for name, picture in drawn.items():
        write_whole(folder / name, picture, force=force)
    return list(drawn)


def _png(ax: "Axes") -> bytes:
    figure = ax.get_figure(root=True)
    assert figure is not None  # axes() made one
    picture = BytesIO()
    figure.savefig(picture, format="png", dpi=150, bbox_inches="tight")
    return picture.getvalue()
