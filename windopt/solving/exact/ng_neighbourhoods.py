"""Ng-neighbourhoods: what a partial flight remembers of where it has been.

A turbine may be visited again only after one whose neighbourhood leaves it out [1]. Small
neighbourhoods make few labels and a weaker bound, so they start small and grow along the cycles
of the fractional plan at hand [2].

* [1] Baldacci, Mingozzi & Roberti (2011), *Operations Research* 59, 1269-1283.
* [2] Roberti & Mingozzi (2014), *Transportation Science* 48, 413-424 (dynamic ng-relaxation).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from windopt.solving.exact.labels import Memory
from windopt.solving.exact.network import Floats

WIDEST = 64
"""Neighbours that one word can hold."""


@dataclass(frozen=True)
class Neighbourhoods:
    """The neighbours of each turbine, itself among them."""

    sets: tuple[frozenset[int], ...]

    @cached_property
    def memory(self) -> Memory:
        """The same in local numbers."""
        n = len(self.sets)
        bit = np.zeros((n, n), np.uint64)
        member = np.zeros((n, WIDEST), np.int32)
        for i, neighbours in enumerate(self.sets):
            for position, j in enumerate(sorted(neighbours)):
                bit[i, j] = np.uint64(1) << np.uint64(position)
                member[i, position] = j
        return Memory(bit, member)

    def admit(self, path: tuple[int, ...]) -> bool:
        """Tell whether ``path`` returns to no turbine that it remembers."""
        remembered: frozenset[int] = frozenset()
        for j in path:
            if j in remembered:
                return False
            remembered = (remembered & self.sets[j]) | {j}
        return True

    def grown_along(self, paths: Iterable[tuple[int, ...]], limit: int) -> "Neighbourhoods":
        """Return neighbourhoods of up to ``limit`` turbines that forbid the cycles of ``paths``."""
        sets = [set(neighbours) for neighbours in self.sets]
        for path in paths:
            seen: dict[int, int] = {}
            for position, j in enumerate(path):
                if j in seen:
                    between = path[seen[j] + 1 : position]
                    if all(j in sets[i] or len(sets[i]) < limit for i in between):
                        for i in between:
                            sets[i].add(j)
                seen[j] = position
        return Neighbourhoods(tuple(frozenset(neighbours) for neighbours in sets))


def nearest(legs: Floats, size: int) -> Neighbourhoods:
    """Return the ``size`` nearest turbines of each, itself among them.

    Parameters
    ----------
    legs
        Time there and back between turbines, shape ``(n, n)``. Turbines at no distance are
        always neighbours: a cycle among them would take no time.
    """
    distance = legs.copy()
    np.fill_diagonal(distance, -1.0)
    order = np.argsort(distance, axis=1, kind="stable")
    sets = []
    for i, row in enumerate(order):
        here = int((distance[i] <= 1e-6).sum())
        sets.append(frozenset(row[: min(max(size, here), WIDEST)].tolist()))
    return Neighbourhoods(tuple(sets))
