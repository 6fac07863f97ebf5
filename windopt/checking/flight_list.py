"""A list of flights, one for each set of turbines or of each station, and their reduced costs."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windopt.domain.certificate import Round

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

PART = 1 << 14
"""Flights to price at once, so that their turbines fit into memory."""


@dataclass(frozen=True, eq=False)
class FlightList:
    """Flights over sets of turbines.

    Parameters
    ----------
    time, station
        Of each flight, shape ``(m,)``.
    visited
        Its turbines as bits, shape ``(m, words)``.
    n
        Number of turbines.
    """

    time: Floats
    station: NDArray[np.int64]
    visited: NDArray[np.uint64]
    n: int

    def __len__(self) -> int:
        return len(self.time)

    def kept(self, keep: Bools | NDArray[np.intp]) -> "FlightList":
        """Return the flights ``keep``."""
        return FlightList(self.time[keep], self.station[keep], self.visited[keep], self.n)

    @property
    def members(self) -> Bools:
        """Whether each flight visits each turbine, shape ``(m, n)``."""
        # Words are read as bytes, lowest first, on machines of either kind.
        as_bytes = np.ascontiguousarray(self.visited.astype("<u8")).view(np.uint8)
        bits = np.unpackbits(as_bytes, axis=1, bitorder="little", count=self.n)
        members: Bools = bits.view(bool)
        return members

    def visit(self, i: int) -> Bools:
        """Return whether each flight visits turbine i, shape ``(m,)``."""
        visits: Bools = self.visited[:, i >> 6] >> np.uint64(i & 63) & np.uint64(1) == 1
        return visits

    def visited_at_all(self) -> Bools:
        """Return whether any flight visits each turbine, shape ``(n,)``."""
        visited = np.zeros(self.n, bool)
        for part in self._parts():
            visited |= part.members.any(axis=0)
        return visited

    def reduced_costs(self, given: Round) -> Floats:
        """Return the time of each flight, less what it earns and plus what it pays [s]."""
        toll = given.tolls[:-1] + given.tolls[-1]
        earned = [_earned(part.members, given) for part in self._parts()]
        cost: Floats = self.time - toll[self.station] - np.concatenate([np.zeros(0), *earned])
        return cost

    def _parts(self) -> Iterator["FlightList"]:
        for start in range(0, len(self), PART):
            yield self.kept(np.arange(start, min(start + PART, len(self))))


def _earned(members: Bools, given: Round) -> Floats:
    """Return prices less penalties of flights that visit ``members``, shape ``(m, n)``."""
    earned: Floats = members @ given.prices
    by_turbine = np.ascontiguousarray(members.T)
    for (i, j, k), penalty in zip(given.triples, given.penalties, strict=True):
        a, b, c = by_turbine[i], by_turbine[j], by_turbine[k]
        earned -= penalty * ((a & b) | (c & (a | b)))
    return earned


def fastest_of_each_set(flights: FlightList, *, apart: bool) -> FlightList:
    """Return the fastest flight over each set of turbines, or of each station if ``apart``."""
    keys = (flights.visited, flights.station) if apart else (flights.visited,)
    return flights.kept(fastest(flights.time, *keys))


def fastest(time: Floats, *keys: NDArray[np.generic]) -> NDArray[np.intp]:
    """Return the rows of least time among those that agree in all ``keys``."""
    columns = [column for key in keys for column in (key.T if key.ndim == 2 else [key])]
    order = np.lexsort((time, *columns))
    first = np.ones(len(order), bool)
    if len(order):
        first[1:] = np.any([np.diff(column[order]) != 0 for column in columns], axis=0)
    return order[first]
