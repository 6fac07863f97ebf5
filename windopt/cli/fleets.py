"""From the options of a command to a fleet."""

from pathlib import Path

from windopt.cli.terminal import counted, note
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Uav
from windopt.errors import InvalidInput
from windopt.io.built_in import built_in_farm, built_in_stations
from windopt.io.stations import read_stations
from windopt.planning.stations import stations_by_k_means


def fleet(farm: Farm, stations: str, uav: Uav, *, dwell: float, seed: int) -> Fleet:
    """Return the stations asked for: a number, a file, or what the farm has by default.

    Raises
    ------
    InvalidInput
        If ``stations`` is neither a number nor a file that exists.
    """
    if not stations:
        return _by_default(farm, uav, dwell=dwell, seed=seed)
    if (count := _number(stations)) is not None:
        return stations_by_k_means(farm, count, uav=uav, dwell=dwell, seed=seed)
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
    placed = stations_by_k_means(farm, uav=uav, dwell=dwell, seed=seed)
    note((f"{counted(len(placed), 'station')} placed by k-means; name your own with --stations.",))
    return placed
