r"""What one flight can serve: sets of turbines that need two, and so attract two units of x.

Where no flight from any station serves all of S in time, at least two fly into it:

.. math:: \sum_d \sum_{i \notin S} \sum_{j \in S} x_{dij} \ge 2                  \tag{1}

These rows are to the flight time what rounded capacity inequalities are to loads (Laporte,
Nobert & Desrochers 1985, *Operations Research* 33, 1050-1073), but the need for a second flight
is decided exactly, by dynamic programming over the orders in which S can be flown. A flight may
call at other turbines between those of S, so legs count with the least time over any detour. That
differs from the time of the leg only where times break the triangle inequality, and it means that
a set which holds one in need of two flights needs two itself.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from formulations.network import ROUNDING, Network
from formulations.subtours import Nodes

LARGEST = 10  # Turbines in a set that is still decided; the effort doubles with each.


@dataclass(frozen=True)
class OneFlight:
    """Decides what one flight of ``arcs`` can serve, and remembers it."""

    arcs: Network
    known: dict[Nodes, bool] = field(default_factory=dict)

    def serves(self, S: Nodes) -> bool:
        """Return whether one flight from some station can serve all nodes of ``S`` in time.

        It may pass other nodes, or the same ones again, wherever that is faster.
        """
        if S not in self.known:
            stations = range(len(self.arcs.tau))
            self.known[S] = any(self._serves_from(d, np.array(S)) for d in stations)
        return self.known[S]

    def crowded_sets(self, x: NDArray[np.float64], tol: float = 0.02) -> Iterator[Nodes]:
        """Yield sets that need two flights, and into which less than two units of ``x`` fly.

        A set grows from each turbine by the one most strongly tied to it, until it needs two
        flights; the search is fast and misses some sets.

        Parameters
        ----------
        x
            Use of each arc, stations merged into node 0, shape ``(n + 1, n + 1)``.
        tol
            Violation below which a row counts as kept.
        """
        ties = x + x.T
        found = set()
        for first in range(1, len(x)):
            S = np.zeros(len(x), dtype=bool)
            S[first] = True
            crowded = False
            while True:
                strength = np.where(S, 0.0, ties[S].sum(axis=0))
                strength[0] = 0.0
                if strength.max() <= 0.0 or (not crowded and S.sum() == LARGEST):
                    break
                S[strength.argmax()] = True
                nodes = tuple(np.flatnonzero(S).tolist())
                crowded = crowded or not self.serves(nodes)
                if crowded and nodes not in found and x[~S][:, S].sum() < 2.0 - tol:
                    found.add(nodes)
                    yield nodes

    def _serves_from(self, d: int, S: NDArray[np.intp]) -> bool:
        """Return whether one flight from station d can serve all of ``S``.

        Each step holds, for every (set of turbines served, last of them), the least time; those
        from which the station is out of reach are dropped.
        """
        tau, omega = self.arcs.shortest[d][np.ix_(S, S)], self.arcs.omega[d, S]
        bit = 1 << np.arange(len(S))
        served, last, time = bit, np.arange(len(S)), self.arcs.alpha[d, S]
        for _ in range(len(S) - 1):
            arrival = time[:, None] + tau[last]
            step, last = np.nonzero(
                (served[:, None] & bit == 0) & (arrival + omega <= 1.0 + ROUNDING)
            )
            served, time = served[step] | bit[last], arrival[step, last]
            order = np.lexsort((time, last, served))
            served, last, time = served[order], last[order], time[order]
            least = np.ones(len(order), dtype=bool)
            least[1:] = (np.diff(served) != 0) | (np.diff(last) != 0)
            served, last, time = served[least], last[least], time[least]
        return bool((time + omega[last] <= 1.0 + ROUNDING).any())
