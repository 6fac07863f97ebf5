"""UAVs and the stations they fly from."""

from dataclasses import dataclass
from math import isnan

from windopt.domain.farm import require_distinct
from windopt.domain.turbine import require_finite, require_positive
from windopt.errors import InvalidInput


@dataclass(frozen=True)
class Uav:
    """What UAVs of one make have in common; the defaults are the paper's AscTec Falcon 8.

    Parameters
    ----------
    name
        Make and model.
    airspeed
        The fastest it flies through the air, u_max [m/s].
    t_max
        The longest a flight may last, from take-off to landing [s].
    wind_max
        The strongest wind it flies in [m/s].
    ground_speed_cap
        Whether ``airspeed`` caps the speed over ground too, as in the paper's (8h).
    """

    name: str = "AscTec Falcon 8"
    airspeed: float = 16.0
    t_max: float = 1080.0
    wind_max: float = 15.0
    ground_speed_cap: bool = True

    def __post_init__(self) -> None:
        require_positive("airspeed", self.airspeed)
        require_positive("t_max", self.t_max)
        if isnan(self.wind_max) or self.wind_max < 0:
            raise InvalidInput("wind_max", ">= 0", self.wind_max)


FALCON_8 = Uav()
"""The paper's UAV."""


@dataclass(frozen=True)
class Station:
    """A place that UAVs of one make take off from and land at.

    Parameters
    ----------
    name
        Distinct within its fleet.
    x, y
        Easting and northing in the farm's CRS [m].
    uav
        The make of UAV kept there.
    max_flights
        How many flights its UAVs and batteries are good for in the time at hand; any number
        unless given.
    """

    name: str
    x: float
    y: float
    uav: Uav = FALCON_8
    max_flights: int | None = None

    def __post_init__(self) -> None:
        if not self.name:
            raise InvalidInput("station name", "to be a non-empty string", repr(self.name))
        require_finite(f"x of station {self.name}", self.x)
        require_finite(f"y of station {self.name}", self.y)
        most = self.max_flights
        if most is not None and not (most >= 0 and most == int(most)):
            raise InvalidInput(f"max_flights of station {self.name}", "a whole number >= 0", most)


@dataclass(frozen=True)
class Fleet:
    """All stations of a farm, each with its UAVs."""

    stations: tuple[Station, ...]

    def __post_init__(self) -> None:
        if not self.stations:
            raise InvalidInput("stations", "to name at least one station", "an empty fleet")
        require_distinct("station names", self.names)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the stations, in order."""
        return tuple(station.name for station in self.stations)

    @property
    def limited(self) -> bool:
        """Whether a station may run out of flights."""
        return any(station.max_flights is not None for station in self.stations)

    def __len__(self) -> int:
        return len(self.stations)
