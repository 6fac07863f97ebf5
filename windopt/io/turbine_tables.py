"""Tables that say something of turbines by name: a number of each, or their stations."""

from pathlib import Path

from windopt.io.csv_files import CsvFile


def read_numbers(path: str | Path, column: str) -> dict[str, float]:
    """Read a number of each turbine from a CSV file.

    Parameters
    ----------
    path
        Columns ``turbine`` and ``column``.

    Raises
    ------
    InvalidInput
        Naming the column and the line that cannot be used, or the turbine that is named twice.
    """
    turbines, numbers = CsvFile.open(path).columns(["turbine", column])
    names = turbines.names()
    for row, name in enumerate(names):
        if name in names[:row]:
            raise turbines.refuse(row, "to be named once")
    return dict(zip(names, numbers.numbers().tolist(), strict=True))


def read_stations_of_turbines(path: str | Path) -> dict[str, tuple[str, ...]]:
    """Read which stations may inspect which turbine from a CSV file.

    Parameters
    ----------
    path
        Columns ``turbine`` and ``station``; a turbine with several stations has several rows.

    Raises
    ------
    InvalidInput
        Naming the column and the line that cannot be used.
    """
    turbines, stations = CsvFile.open(path).columns(["turbine", "station"])
    allowed: dict[str, tuple[str, ...]] = {}
    for turbine, station in zip(turbines.names(), stations.names(), strict=True):
        allowed[turbine] = (*allowed.get(turbine, ()), station)
    return allowed
