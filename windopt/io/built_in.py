"""The farm, the stations and the wind that come with windopt; see ``windopt/data/NOTICE.md``."""

from dataclasses import replace
from pathlib import Path

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Uav
from windopt.domain.wind import WindSeries
from windopt.io.series import read_series
from windopt.io.stations import read_stations
from windopt.io.windio import farm_from_windio
from windopt.io.yaml_files import read_yaml

DATA = Path(__file__).parents[1] / "data"
WALNEY = "Walney"


def built_in_farm() -> Farm:
    """Return Walney: Walney 1, Walney 2 and Walney Extension, 189 turbines in the Irish Sea.

    Turbines are called as in the paper, row first, then farm, then number: B110 is B10 of
    Walney 1, A213 is A13 of Walney 2 and A411 is A11 in area 4 of the Extension.
    """
    return farm_from_windio(read_yaml(DATA / "walney.yaml"), "OptiWindNet 0.3.2 (MIT)")


def built_in_stations(uav: Uav = FALCON_8) -> Fleet:
    """Return stations for Walney, from which ``uav`` reaches every turbine in usual winds."""
    return read_stations(DATA / "walney.stations.csv", uav=uav)


def built_in_series() -> WindSeries:
    """Return a month of wind at 100 m from the weather model WRF, in steps of 10 minutes."""
    series = read_series(DATA / "wrf-2009-01.csv.gz")
    return replace(series, source="foxes 1.9.8 (MIT): WRF, January 2009, 100 m")
