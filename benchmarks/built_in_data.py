"""Make the built-in farm, stations and wind from the packages that publish them.

``python -m benchmarks.built_in_data`` needs OptiWindNet and foxes installed; their licences and
what is taken from each are in ``windopt/data/NOTICE.md``.
"""

import csv
import gzip
from importlib.metadata import version
from importlib.resources import files
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2

from windopt.domain.farm import Farm
from windopt.domain.fleet import Uav
from windopt.io.built_in import built_in_farm
from windopt.io.optiwindnet import optiwindnet_farm
from windopt.io.whole_files import write_whole

Floats = NDArray[np.float64]

DATA = Path(__file__).parents[1] / "windopt" / "data"
HEIGHT = 100  # m; of the heights in the series the nearest to the hub of a turbine of 8 MW
WIND = 12.0  # m/s; in it every turbine is within reach of a station, from wherever it blows

MADE = "# Made by benchmarks/built_in_data.py; see NOTICE.md beside this file.\n"
PLANT_HEADER = f"""\
# Walney 1, Walney 2 and Walney Extension, in the layout of windIO 2.
# Positions: OptiWindNet {version("optiwindnet")} (MIT), from KIS-ORCA's charts; m, UTM zone 30N.
# Left out, as OptiWindNet does not give them: hub heights, power and thrust curves.
{MADE}"""
STATIONS_HEADER = f"""\
# Stations for Walney: centres of k-means over its turbines; metres, UTM zone 30N.
{MADE}"""
SERIES_HEADER = f"""\
# Wind at {HEIGHT} m every 10 minutes, WRF model, January 2009: foxes {version("foxes")} (MIT).
{MADE}"""

MODELS = {
    "1": ("SWT-3.6-107", 3.6e6, 107.0),
    "2": ("SWT-3.6-120", 3.6e6, 120.0),
    "3": ("V164-8.0", 8.25e6, 164.0),
    "4": ("SWT-7.0-154", 7.0e6, 154.0),
}
"""Name, rated power [W] and rotor diameter [m] of what was built in each phase, by the phase's
digit in a turbine's name; models and ratings as in OptiWindNet's files, diameters as in the names
of the models."""


def walney() -> dict[str, Any]:
    """Return Walney 1, Walney 2 and Walney Extension as one windIO wind farm."""
    farms = [optiwindnet_farm(name) for name in ("Walney 1", "Walney 2", "Walney Extension")]
    one, two, extension = farms
    names = [f"{name[0]}1{name[1:]}" for name in one.names]  # B10 is B110
    names += [f"{name[0]}2{name[1:]}" for name in two.names]  # A13 is A213
    names += [f"{name[2]}{name[0]}{name[3:]}" for name in extension.names]  # 4-A11 is A411
    return {
        "name": "Walney",
        "layouts": [
            {
                "coordinates": {**_coordinates(np.vstack([f.xy for f in farms])), "crs": one.crs},
                "turbine_types": [int(name[1]) for name in names],
                "turbine_identifiers": names,
            }
        ],
        "turbine_types": {int(phase): _turbine(*model) for phase, model in MODELS.items()},
        "electrical_substations": [
            {"electrical_substation": {"coordinates": _coordinates(np.array([place]))}}
            for farm in farms
            for place in farm.substations
        ],
    }


def _coordinates(xy: Floats) -> dict[str, list[float]]:
    return dict(zip("xy", xy.T.round(2).tolist(), strict=True))


def _turbine(name: str, rated_power: float, diameter: float) -> dict[str, Any]:
    performance = {"rated_power": rated_power}
    return {"name": name, "performance": performance, "rotor_diameter": diameter}


def station_positions(xy: Floats, uav: Uav, wind: float) -> Floats:
    """Return the fewest centres of k-means from which ``uav`` reaches every turbine.

    Out and back it is slowest along the wind: against it the UAV makes ``airspeed - wind`` over
    ground, and with it no more than ``airspeed``.
    """
    reach = uav.t_max / (1 / (uav.airspeed - wind) + 1 / uav.airspeed)
    k, distance = 0, np.full(len(xy), np.inf)
    while distance.max() > reach:
        k += 1
        centres, _ = kmeans2(xy, k, minit="++", iter=100, rng=0)
        distance = np.linalg.norm(xy[:, None] - centres[None], axis=2).min(axis=1)
    return centres[centres[:, 0].argsort()]


def stations(farm: Farm) -> str:
    """Return stations for a farm as a table."""
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("id", "x", "y"))
    for number, (x, y) in enumerate(station_positions(farm.xy, Uav(), WIND).tolist(), start=1):
        rows.writerow((f"S{number}", f"{x:.1f}", f"{y:.1f}"))
    return text.getvalue()


def series() -> str:
    """Return the wind at one height of foxes' WRF month as a table."""
    file = files("foxes") / "data" / "states" / "WRF-Timeseries-4464.csv.gz"
    months = csv.DictReader(StringIO(gzip.decompress(file.read_bytes()).decode()))
    text = StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("time", "speed", "direction"))
    for row in months:
        rows.writerow((row["Time"], row[f"WS-{HEIGHT}"], row[f"WD-{HEIGHT}"]))
    return text.getvalue()


def main() -> None:
    """Write the files into the package."""
    plant = yaml.safe_dump(walney(), sort_keys=False, default_flow_style=None, width=100)
    write_whole(DATA / "walney.yaml", PLANT_HEADER + plant, force=True)
    write_whole(
        DATA / "walney.stations.csv", STATIONS_HEADER + stations(built_in_farm()), force=True
    )
    wind = gzip.compress((SERIES_HEADER + series()).encode(), mtime=0)
    write_whole(DATA / "wrf-2009-01.csv.gz", wind, force=True)


if __name__ == "__main__":
    main()
