"""From the options of a command to a fleet."""

from pathlib import Path

from windopt.cli.terminal import counted, note
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Uav
from windopt.errors import InvalidInput
from windopt.io.built_in import built_in_farm, built_in_stations
from windopt.io.stations import read_stations
from windopt.planning.station_design import station_design
from windopt.planning.stations import stations_by_cover, stations_by_k_means


def fleet(farm: Farm, stations: str, uav: Uav, *, dwell: float, seed: int) -> Fleet:
    """Return the stations asked for: a number, a file, or what the farm has by default.

    Raises
    ------
    InvalidInput
        If ``stations`` is neither a number nor a file that exists, or none can be placed.
    """
    if not stations:
        return _by_default(farm, uav, dwell=dwell, seed=seed)
    if (count := _number(stations)) is not None:
        return _as_many(farm, count, uav, dwell=dwell, seed=seed)
    if not Path(stations).exists():
        raise InvalidInput("--stations", "to be a number or a file that exists", stations)
    return read_stations(stations, farm, uav=uav)


def _number(text: str) -> int | None:
    try:
        return int(text)
    except ValueError:
        return None


def _by_default(farm: Farm, uav: Uav, *, dwell: float, seed: int) -> Fleet:
    if farm == built_in_farm():
        return built_in_stations(uav)
    _require_short(farm, uav, dwell)
    placed = stations_by_cover(farm, uav=uav, dwell=dwell, seed=seed)
    if placed.solution is None:
        raise InvalidInput("--stations", "to be given, as the search for them ended early", "none")
    fewest = counted(len(placed.solution), "station")
    reach = "the fewest that reach every turbine in the winds they are designed for"
    note((f"{fewest} placed, {reach}; name your own with --stations.",))
    return placed.solution


def _require_short(farm: Farm, uav: Uav, dwell: float) -> None:
    """Refuse a dwell that leaves no flight the reserve for which stations are placed."""
    design = station_design(farm, uav=uav, dwell=dwell)
    longest = design.longest
    if dwell > longest:
        kept = f"{100 * design.margin:g} % of --t-max"
        why = f"as stations are placed so that {kept} is left on landing"
        own = ", or --stations of your own" if dwell < uav.t_max else ""
        raise InvalidInput("--dwell", f"<= {longest:g} s, {why}{own}", f"{dwell:g}")


def _as_many(farm: Farm, count: int, uav: Uav, *, dwell: float, seed: int) -> Fleet:
    """Return a number of stations that reach every turbine or, where none do, those of k-means."""
    placed = stations_by_cover(farm, count, uav=uav, dwell=dwell, seed=seed)
    if placed.solution is not None:
        return placed.solution
    note((f"Stations placed by k-means. {placed.reason}",))
    return stations_by_k_means(farm, count, uav=uav, seed=seed)
