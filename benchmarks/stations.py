"""The stations of each farm, by one rule."""

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.planning.stations import stations_by_k_means


def stations(handle: str, farm: Farm, dwell: float) -> Fleet:
    """Return the stations of a farm for a dwell [s]."""
    return stations_by_k_means(farm, dwell=dwell)
