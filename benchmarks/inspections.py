"""Instances of inspection routing: a farm, a wind and a dwell, all said by a name.

``horns-w10-090-d060`` is Horns Rev 1 in 10 m/s from 90 degrees with 60 s at each turbine. A farm
goes by its handle in OptiWindNet; ``grid300`` is 300 turbines in a square grid, which is there to
see how times grow. The UAV is the paper's, and the stations are those of
:mod:`benchmarks.stations`.
"""

import json
import re
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from math import ceil, sqrt

from benchmarks.case import Record
from benchmarks.stations import stations
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput

NAME = re.compile(r"(?P<farm>.+)-w(?P<speed>\d{2})-(?P<direction>\d{3})-d(?P<dwell>\d{3})")
SPACING = 1000.0
"""Between neighbours of a grid [m]; some seven rotor diameters, as offshore."""


@dataclass(frozen=True)
class Inspection:
    """One instance.

    Parameters
    ----------
    handle
        Of the farm.
    speed, direction
        Of the wind [m/s], and where it blows from [deg].
    dwell
        Time at each turbine [s].
    """

    handle: str
    speed: int
    direction: int
    dwell: int

    @classmethod
    def named(cls, name: str) -> "Inspection":
        """Return the instance of a name.

        Raises
        ------
        InvalidInput
            If the name is not of the form above.
        """
        parts = NAME.fullmatch(name)
        if parts is None:
            raise InvalidInput("instance", "to be like horns-w10-090-d060", repr(name))
        numbers = (int(parts[field]) for field in ("speed", "direction", "dwell"))
        return cls(parts["farm"], *numbers)

    @property
    def name(self) -> str:
        """The name, which says all there is to say."""
        return f"{self.handle}-w{self.speed:02d}-{self.direction:03d}-d{self.dwell:03d}"

    @cached_property
    def farm(self) -> Farm:
        """The farm."""
        grid = re.fullmatch(r"grid(\d+)", self.handle)
        return square_grid(int(grid[1])) if grid else Farm.load(self.handle)

    @cached_property
    def fleet(self) -> Fleet:
        """The stations."""
        return stations(self.handle, self.farm, self.dwell)

    @property
    def wind(self) -> Wind:
        """The wind."""
        return Wind.from_met(self.speed, self.direction)

    @property
    def hash(self) -> str:
        """A fingerprint of all positions, to the centimetre, and of every other number."""
        uavs = [(s.uav.airspeed, s.uav.t_max, s.uav.ground_speed_cap) for s in self.fleet.stations]
        numbers = {
            "turbines": self.farm.xy.round(2).tolist(),
            "stations": [(round(s.x, 2), round(s.y, 2)) for s in self.fleet.stations],
            "uavs": uavs,
            "wind": (self.speed, self.direction),
            "dwell": self.dwell,
        }
        return sha256(json.dumps(numbers, sort_keys=True).encode()).hexdigest()[:12]

    @property
    def facts(self) -> Record:
        """What a line says of the instance."""
        return {
            "hash": self.hash,
            "farm": self.farm.name,
            "turbines": len(self.farm),
            "stations": len(self.fleet),
            "wind_speed": self.speed,
            "wind_direction": self.direction,
            "dwell": self.dwell,
        }


def square_grid(n: int) -> Farm:
    """Return n turbines in rows and columns, as square as n allows."""
    columns = ceil(sqrt(n))
    turbines = tuple(
        Turbine(f"G{i + 1:03d}", SPACING * (i % columns), SPACING * (i // columns))
        for i in range(n)
    )
    return Farm(f"Grid of {n}", turbines)
