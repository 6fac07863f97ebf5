"""The inspection problem in numbers: what every routing method takes and returns."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput


class Route(NamedTuple):
    """One flight in numbers: its station, and the turbines it visits in order, from 0."""

    station: int
    turbines: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class RoutingInstance:
    """k stations, n turbines, and the time between them under one wind.

    Parameters
    ----------
    t
        ``t[d, i, j]``: time [s] that the UAV of station d needs from leaving i until it is
        done at j, inspection included; shape ``(k, n + 1, n + 1)``. Node 0 is the station,
        node i the i-th turbine; ``inf`` where the leg cannot be flown.
    t_max
        Longest flight of each station's UAV [s], shape ``(k,)``.
    stations, turbines
        Positions [m], shapes ``(k, 2)`` and ``(n, 2)``.
    w
        Velocity of the air [m/s], shape ``(2,)``.
    allowed
        Whether station d may serve turbine i, shape ``(k, n)``.
    airspeed
        Greatest airspeed of each station's UAV [m/s], shape ``(k,)``; unlimited unless given.
    prize
        What inspecting each turbine is worth [s of flight], shape ``(n,)``: a plan may leave it
        out and pays the prize. Every turbine must be inspected unless given.
    max_flights
        Most flights of each station, shape ``(k,)``, ``inf`` for any number; any number unless
        given. It asks for a prize, as not every turbine may then fit.
    """

    t: NDArray[np.float64]
    t_max: NDArray[np.float64]
    stations: NDArray[np.float64]
    turbines: NDArray[np.float64]
    w: NDArray[np.float64]
    allowed: NDArray[np.bool_]
    airspeed: NDArray[np.float64] | float = inf
    prize: NDArray[np.float64] | None = None
    max_flights: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        k, n = len(self.stations), len(self.turbines)
        for field, array, shape in (
            ("t", self.t, (k, n + 1, n + 1)),
            ("t_max", self.t_max, (k,)),
            ("w", self.w, (2,)),
            ("allowed", self.allowed, (k, n)),
            ("airspeed", np.asarray(self.airspeed), (k,) if np.ndim(self.airspeed) else ()),
            ("prize", self.prize, (n,)),
            ("max_flights", self.max_flights, (k,)),
        ):
            if array is not None and array.shape != shape:
                raise InvalidInput(field, f"of shape {shape}", array.shape)
        for field, limits in ("t_max", self.t_max), ("airspeed", self.airspeed):
            if not np.all(np.greater(limits, 0)):
                raise InvalidInput(field, "> 0", limits)
        if np.isnan(self.t).any() or (self.t < 0).any():
            raise InvalidInput("t", ">= 0", "a negative or missing time")
        if self.prize is not None and not ((self.prize >= 0) & np.isfinite(self.prize)).all():
            raise InvalidInput("prize", ">= 0 and finite", self.prize)
        if self.max_flights is not None:
            if self.prize is None:
                raise InvalidInput("prize", "where flights are limited", "none")
            if not (self.max_flights >= 0).all():
                raise InvalidInput("max_flights", ">= 0", self.max_flights)

    @property
    def round_trip(self) -> NDArray[np.float64]:
        """Time of the flight that visits one turbine only [s], shape ``(k, n)``."""
        return self.t[:, 0, 1:] + self.t[:, 1:, 0]

    @property
    def reachable(self) -> NDArray[np.bool_]:
        """Whether station d can inspect turbine i and be back in time, shape ``(k, n)``."""
        return self.allowed & (self.round_trip <= self.t_max[:, None])

    def subset(self, turbines: Sequence[int]) -> "RoutingInstance":
        """Return the instance of some turbines, and of all stations and their limits.

        Parameters
        ----------
        turbines
            Which, from 0 and in the order wanted.
        """
        chosen = np.asarray(turbines, dtype=int)
        nodes = np.append(0, chosen + 1)
        return replace(
            self,
            t=self.t[:, nodes[:, None], nodes],
            turbines=self.turbines[chosen],
            allowed=self.allowed[:, chosen],
            prize=None if self.prize is None else self.prize[chosen],
        )

    def require_all(self, method: str) -> None:
        """Refuse an instance from which turbines may be left out.

        Raises
        ------
        InvalidInput
            If it has prizes; ``method`` says who cannot weigh them.
        """
        if self.prize is not None:
            raise InvalidInput(
                "method", "exact where flights are few or turbines have a worth", method
            )

    def duration(self, route: Route) -> float:
        """Time from take-off to landing [s]."""
        nodes = (0, *(i + 1 for i in route.turbines), 0)
        return float(sum(self.t[route.station, i, j] for i, j in pairwise(nodes)))

    def total(self, routes: tuple[Route, ...]) -> float:
        """Time of all flights together [s]."""
        return sum(self.duration(route) for route in routes)

    def cost(self, routes: tuple[Route, ...]) -> float:
        """Time of all flights together, and the prizes of the turbines they leave out [s]."""
        if self.prize is None:
            return self.total(routes)
        left_out = np.ones(len(self.turbines), bool)
        left_out[[i for route in routes for i in route.turbines]] = False
        return self.total(routes) + float(self.prize[left_out].sum())
