"""The legs each station's UAV may still fly, seen from both ends of a flight.

A flight read backwards is a flight in the transposed network, so every search below takes a
:class:`Side` and does not know which way it looks.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import RoutingInstance

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SLACK = 1e-7
"""What a flight may last beyond t_max for rounding, in thousandths of a t_max / 1000."""
SHORTEST = 1e-9
"""A t_max is no less [s], so that it can be divided into parts."""
UNITS = 1000.0
"""Times are counted in thousandths of the longest t_max, so that tolerances have a meaning."""


class Side(NamedTuple):
    """A station's network in one direction of flying.

    Attributes
    ----------
    first
        Time from the station to each turbine, shape ``(n,)``; ``inf`` where it cannot be flown.
    legs
        Time between turbines, shape ``(n, n)``.
    last
        Time from each turbine to the station at the other end, shape ``(n,)``.
    rest
        Least time from each turbine to the other end, by any way, shape ``(n,)``.
    heads, degree
        The turbines that may follow i are ``heads[i, :degree[i]]``.
    first_cost, legs_cost, last_cost
        What legs cost: their time, less what is granted for flying them.
    """

    first: Floats
    legs: Floats
    last: Floats
    rest: Floats
    heads: NDArray[np.int32]
    degree: NDArray[np.int32]
    first_cost: Floats
    legs_cost: Floats
    last_cost: Floats


@dataclass(frozen=True)
class Network:
    """One station, the legs its UAV may fly, and how long a flight may last."""

    t_max: float
    out: Floats
    legs: Floats
    back: Floats
    arcs: Bools
    forward: Side
    backward: Side

    @classmethod
    def of(cls, out: Floats, legs: Floats, back: Floats, t_max: float, arcs: Bools) -> Self:
        """Make the network of the legs ``arcs``, shape ``(n, n)``."""
        arriving, leaving = _least(out, legs), _least(back, legs.T)
        through = arriving[:, None] + legs + leaving[None, :]
        arcs = arcs & (through <= t_max + SLACK)
        forward = Side(out, legs, back, leaving, *_lists(arcs), out, legs, back)
        turned = np.ascontiguousarray(legs.T)
        backward = Side(back, turned, out, arriving, *_lists(arcs.T), back, turned, out)
        return cls(t_max, out, legs, back, arcs, forward, backward)

    def restricted(self, arcs: Bools) -> "Network":
        """Return the network without the legs that ``arcs`` leaves out."""
        arcs = self.arcs & arcs
        return Network(
            self.t_max,
            self.out,
            self.legs,
            self.back,
            arcs,
            _narrowed(self.forward, arcs),
            _narrowed(self.backward, arcs.T),
        )

    def granted(self, grant: Floats) -> "Network":
        """Return the network in which legs cost their time less ``grant``.

        Parameters
        ----------
        grant
            Shape ``(n + 1, n + 1)``, the station last.
        """
        out, back = self.out - grant[-1, :-1], self.back - grant[:-1, -1]
        legs = self.legs - grant[:-1, :-1]
        turned = np.ascontiguousarray(legs.T)
        forward = self.forward._replace(first_cost=out, legs_cost=legs, last_cost=back)
        backward = self.backward._replace(first_cost=back, legs_cost=turned, last_cost=out)
        return replace(self, forward=forward, backward=backward)

    @property
    def half(self) -> float:
        """Where forward and backward labels meet: half of t_max."""
        return self.t_max / 2

    def duration(self, path: tuple[int, ...]) -> float:
        """Time of the flight along ``path``."""
        legs = sum(self.legs[i, j] for i, j in pairwise(path))
        return float(self.out[path[0]] + legs + self.back[path[-1]])


def networks(instance: RoutingInstance) -> tuple[list[Network], float]:
    """Return the network of each station, and the seconds in one unit of their times."""
    t_max = np.maximum(np.minimum(instance.t_max, _longest_tour(instance.t)), SHORTEST)
    unit = float(t_max.max()) / UNITS
    made = []
    for d, allowed in enumerate(instance.allowed):
        legs = np.where(np.outer(allowed, allowed), instance.t[d, 1:, 1:] / unit, np.inf)
        np.fill_diagonal(legs, np.inf)
        out = np.where(allowed, instance.t[d, 0, 1:] / unit, np.inf)
        back = np.where(allowed, instance.t[d, 1:, 0] / unit, np.inf)
        made.append(Network.of(out, legs, back, float(t_max[d]) / unit, np.isfinite(legs)))
    return made, unit


def _longest_tour(t: Floats) -> Floats:
    """Return a time that no tour of all turbines exceeds, shape ``(k,)``."""
    return np.where(np.isfinite(t), t, 0.0).max(axis=1).sum(axis=1)  # type: ignore[no-any-return]


def _least(first: Floats, legs: Floats) -> Floats:
    """Return the least time from the station to each turbine by any way (Bellman and Ford)."""
    least = first
    while True:
        nearer = np.minimum(least, (least[:, None] + legs).min(axis=0, initial=np.inf))
        if not (nearer < least).any():
            return np.ascontiguousarray(nearer)
        least = nearer


def _lists(arcs: Bools) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    heads = np.argsort(~arcs, axis=1, kind="stable").astype(np.int32)
    return heads, arcs.sum(axis=1, dtype=np.int32)


def _narrowed(side: Side, arcs: Bools) -> Side:
    heads, degree = _lists(arcs)
    return side._replace(heads=heads, degree=degree)
