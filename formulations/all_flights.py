"""Every flight of a small farm, listed, for the program that chooses among flights.

Of the flights of a station over the same turbines only the fastest can be in a best plan, and
there is one for each set of turbines that fits into the longest flight. Dynamic programming finds
it from those over one turbine fewer [1]. Their number about doubles with each turbine: a dozen are
no matter, twenty are too many.

* [1] Held & Karp (1962), *Journal of the Society for Industrial and Applied Mathematics* 10,
  196-210.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csc_array

from formulations.network import ROUNDING, Network, network
from formulations.set_partitioning import INF, set_partitioning

Flight = tuple[int, tuple[int, ...]]
Paths = dict[tuple[int, int], tuple[float, tuple[int, ...]]]  # by turbines, as bits, and the last
VIOLATION = 1e-6


@dataclass(frozen=True)
class AllFlights:
    """The program of :mod:`formulations.set_partitioning` over a list of flights, without (5)."""

    model: highspy.Highs
    x: HighspyArray  # (flights,)
    flights: list[Flight]
    visits: NDArray[np.bool_]  # (flights, n) whether a flight visits a turbine

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield the rows (5) that ``x`` violates; whole ``x`` violate none."""
        for S in combinations(range(self.visits.shape[1]), 3):
            pairs = self.visits[:, S].sum(axis=1) >= 2
            if x[pairs].sum() > 1.0 + VIOLATION:
                yield self.x[pairs].sum() <= 1

    def routes(self, x: NDArray[np.float64]) -> list[Flight]:
        """Return the flights of ``x``: each one's station and its turbines in order, from 0."""
        return [self.flights[r] for r in np.flatnonzero(x > 0.5)]

    def point(self, routes: Sequence[Flight]) -> NDArray[np.float64]:
        """Return the ``x`` of flights, as :meth:`routes` gives them."""
        known = {(d, frozenset(path)): r for r, (d, path) in enumerate(self.flights)}
        x = np.zeros(len(self.flights))
        x[[known[d, frozenset(path)] for d, path in routes]] = 1.0
        return x


def all_flights(
    t: NDArray[np.float64],
    t_max: ArrayLike,
    *,
    allowed: NDArray[np.bool_] | None = None,
    most: ArrayLike = INF,
    prize: ArrayLike | None = None,
) -> AllFlights:
    """Build the program (1)-(4), (6) over every flight that may be in a best plan.

    Parameters
    ----------
    t
        Time from leaving i until done at j, inspection included [s], shape
        ``(k, n + 1, n + 1)``, or ``(n + 1, n + 1)`` for one station; ``inf`` where the leg cannot
        be flown.
    t_max
        Longest flight of each station's UAV [s], shape ``(k,)`` or one for all.
    allowed
        Whether station d may serve turbine i, shape ``(k, n)``; all by default.
    most
        Most flights of each station, shape ``(k,)`` or one for all; any number by default.
    prize
        What leaving a turbine out costs [s], shape ``(n,)`` or one for all; None where none may be.

    Raises
    ------
    ValueError
        As :func:`formulations.network.network` does.
    """
    arcs = network(t, t_max, allowed)
    k, n = len(arcs.t), arcs.t.shape[1] - 1
    listed = [(c, (d, path)) for d in range(k) for c, path in _fastest(arcs, d)]
    flights = [flight for _, flight in listed]
    visits = np.zeros((len(flights), n), bool)
    sent = np.zeros((len(flights), k + 1))
    sent[:, k] = 1.0
    for r, (d, path) in enumerate(flights):
        visits[r, list(path)] = True
        sent[r, d] = 1.0
    limits = np.append(np.broadcast_to(most, k), INF)
    counts = np.column_stack([np.zeros(k + 1), limits])

    program = set_partitioning(n, counts, price=prize)
    before = program.model.getNumCol()
    c = np.array([time for time, _ in listed])
    program.add_flights(c, csc_array(np.hstack([visits, sent]).T))
    variables = np.array(program.model.getVariables()[before:], dtype=object)
    if not flights:
        program.model.addIntegral(0.0, 0.0)  # HiGHS calls a program without columns empty
    return AllFlights(program.model, HighspyArray(variables, program.model), flights, visits)


def _fastest(arcs: Network, d: int) -> Iterator[tuple[float, tuple[int, ...]]]:
    """Yield time and turbines of station d's fastest flight over each set that fits."""
    t, tau = arcs.t[d], arcs.tau[d]
    n = len(t) - 1
    paths: Paths = {(1 << i, i): (tau[0, i + 1], (i,)) for i in range(n)}
    while paths:
        best: dict[int, tuple[float, float, tuple[int, ...]]] = {}
        longer: Paths = {}
        for (S, i), (so_far, path) in paths.items():
            whole = so_far + tau[i + 1, 0]
            if whole <= 1.0 + ROUNDING and (S not in best or whole < best[S][0]):
                nodes = [0, *(j + 1 for j in path), 0]
                best[S] = whole, float(t[nodes[:-1], nodes[1:]].sum()), path
            for j in np.flatnonzero(so_far + tau[i + 1, 1:] + arcs.omega[d, 1:] <= 1.0 + ROUNDING):
                key, time = (S | 1 << int(j), int(j)), so_far + tau[i + 1, j + 1]
                if not S >> int(j) & 1 and (key not in longer or time < longer[key][0]):
                    longer[key] = time, (*path, int(j))
        yield from ((time, path) for _, time, path in best.values())
        paths = longer
