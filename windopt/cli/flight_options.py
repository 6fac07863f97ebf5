"""The options that every command with inspection flights takes."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from windopt.cli import options as opt
from windopt.cli.checked import at_least, checked
from windopt.cli.fleets import fleet
from windopt.cli.terminal import Told, left_out, seconds
from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Uav
from windopt.errors import InvalidInput, listed
from windopt.io.plans import read_plan
from windopt.io.turbine_tables import read_numbers, read_stations_of_turbines
from windopt.planning.assignment import NEAREST, Assignment
from windopt.planning.inspection import DEFAULT_METHOD
from windopt.planning.routing_methods import chosen_method
from windopt.planning.search_options import MEMORY
from windopt.planning.start import inspection_of
from windopt.planning.worth import unit_of_priority, worth_of_priorities
from windopt.solving.limits import LEAST_MEMORY

GB = 1e9


def _require_memory(field: str, gigabytes: float) -> None:
    if not GB * gigabytes >= LEAST_MEMORY:
        raise InvalidInput(field, f"of at least {LEAST_MEMORY / GB:g} GB", gigabytes)


MaxFlights = Annotated[
    int | None,
    typer.Option(
        callback=checked(at_least(0)),
        help="Flights that each station is good for; as many turbines as possible are then "
        "inspected (method exact). A column max_flights of the stations' file may say fewer for "
        "each.",
    ),
]
Worth = Annotated[
    str,
    typer.Option(
        metavar="SECONDS|FILE",
        help="Flight time that the inspection of a turbine is worth [s]: one for all, or a CSV "
        "file (turbine, worth). What takes longer is left out (method exact).",
    ),
]
Priorities = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="CSV file (turbine, priority), 1 where not named: the greatest sum of priorities "
        "comes first, then the least time.",
    ),
]
Assigned = Annotated[
    str,
    typer.Option(
        metavar="nearest|FILE",
        help="Which stations may inspect which turbine: the nearest, or a CSV file (turbine, "
        "station). By default any.",
    ),
]
Start = Annotated[
    Path | None, typer.Option(metavar="PLAN.json", help="An earlier plan to begin with.")
]
Memory = Annotated[
    float,
    typer.Option(
        callback=checked(_require_memory),
        help="Memory that the method exact may take for its lists [GB].",
    ),
]


@dataclass(frozen=True)
class UavOptions:
    """The make of UAV kept at every station that names no other."""

    airspeed: opt.Airspeed = FALCON_8.airspeed
    t_max: opt.FlightTime = FALCON_8.t_max
    wind_max: opt.WindMax = FALCON_8.wind_max
    ground_speed_cap: opt.GroundSpeedCap = FALCON_8.ground_speed_cap

    @property
    def uav(self) -> Uav:
        """The UAV."""
        return Uav(FALCON_8.name, self.airspeed, self.t_max, self.wind_max, self.ground_speed_cap)


@dataclass(frozen=True)
class FlightOptions:
    """From where, what and how flights are planned."""

    stations: opt.Stations = ""
    max_flights: MaxFlights = None
    dwell: opt.Dwell = 0.0
    worth: Worth = ""
    priorities: Priorities = None
    assignment: Assigned = ""
    method: opt.RoutingMethod = DEFAULT_METHOD
    rule: opt.Rule = "exact"
    start: Start = None
    gap: opt.Gap = 0.0
    time_limit: opt.TimeLimit = 60.0
    memory: Memory = MEMORY / GB
    seed: opt.Seed = 0

    def asked(self, farm: Farm, uav: Uav) -> tuple[Fleet, dict[str, Any]]:
        """Return the stations, and what else :func:`windopt.plan_inspection` is asked by keyword.

        Files are read and methods are refused before stations are placed, which may take long.

        Raises
        ------
        InvalidInput
            If a file cannot be used, worth and priorities are both given, or the method cannot do
            what is asked for.
        """
        few = self.max_flights is not None or self.priorities is not None or self.worth != ""
        chosen_method(self.method, weighs=few, improves=self.start is not None)
        priorities, worth = self._priorities(), self._worth(farm)
        asked = {
            "method": self.method,
            "dwell": self.dwell,
            "rule": self.rule,
            "assignment": self._assignment(),
            "start": None if self.start is None else inspection_of(read_plan(self.start)),
            "gap": self.gap,
            "time_limit": self.time_limit,
            "memory": GB * self.memory,
            "seed": self.seed,
        }
        based = self._fleet(farm, uav)
        if priorities is not None:
            worth = worth_of_priorities(farm, based, priorities)
        return based, {"worth": worth, **asked}

    def told(self, farm: Farm, based: Fleet) -> Told:
        """Return what says how far a search is: not in seconds where turbines come first."""
        if self.worth or not (self.priorities or based.limited):
            return seconds
        what = "priority" if self.priorities else "turbines"
        return left_out(what, unit_of_priority(based, len(farm)))

    def _fleet(self, farm: Farm, uav: Uav) -> Fleet:
        """Return the stations, each with its number of flights."""
        based = fleet(farm, self.stations, uav, dwell=self.dwell, seed=self.seed)
        if self.max_flights is None:
            return based
        most = self.max_flights
        return Fleet(
            tuple(
                replace(station, max_flights=most if own is None else min(own, most))
                for station in based.stations
                for own in [station.max_flights]
            )
        )

    def _priorities(self) -> dict[str, float] | None:
        if self.priorities is None:
            return None
        if self.worth:
            raise InvalidInput("--worth", "or --priorities", "both")
        return read_numbers(self.priorities, "priority")

    def _worth(self, farm: Farm) -> float | tuple[float, ...] | None:
        if not self.worth:
            return None
        try:
            return float(self.worth)
        except ValueError:
            table = read_numbers(_file("--worth", "a number", self.worth), "worth")
        if table.keys() != set(farm.names):
            unknown, missing = table.keys() - set(farm.names), set(farm.names) - table.keys()
            got = listed(sorted(unknown)) if unknown else f"none for {listed(sorted(missing))}"
            raise InvalidInput("--worth", "to name each turbine of the farm and no other", got)
        return tuple(table[name] for name in farm.names)

    def _assignment(self) -> Assignment | None:
        if self.assignment in ("", NEAREST):
            return self.assignment or None
        return read_stations_of_turbines(_file("--assignment", NEAREST, self.assignment))


def _file(option: str, otherwise: str, given: str) -> Path:
    if not Path(given).exists():
        raise InvalidInput(option, f"to be {otherwise} or a file that exists", given)
    return Path(given)
