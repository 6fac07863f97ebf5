r"""Inspection routing with one matrix per route: the paper's (8), corrected.

Station d has the routes :math:`R_d`, :math:`M_d` of them, all of which form :math:`R`. Nodes are
:math:`V = \{0, \dots, n\}`: 0 is the station and the others are the turbines
:math:`N = V \setminus 0`. :math:`x_{rij}`, the paper's :math:`U^m_{i,k,l}`, flies from i to j on
route r.

.. math::

    \min_x \quad & \sum_{rij} t_{rij} x_{rij}                                    \tag{1} \\
    \text{s.t.} \quad & \sum_j x_{r0j} \le 1                        & r \in R    \tag{2} \\
      & \sum_{ri} x_{rij} = 1                                       & j \in N    \tag{3} \\
      & \sum_i x_{rij} = \sum_i x_{rji}                        & r \in R,\ j \in N \tag{4} \\
      & \sum_{ij} t_{rij} x_{rij} \le t^{\max}_r \sum_j x_{r0j}     & r \in R    \tag{5} \\
      & x_{rij} \in \{0, 1\}                                                     \tag{6} \\
      & \sum_r \sum_{i,j \in S} x_{rij} \le |S| - 1            & S \subseteq N   \tag{7} \\
      & x_{rij} = x_{rji} = 0 & r \text{ the } m\text{-th of its station},\ i < m \tag{8} \\
      & \sum_j x_{r0j} \ge \sum_j x_{r+1,0j}          & r, r + 1 \in R_d         \tag{9} \\
      & \sum_{ij \in P} x_{rij} \le |P| - 1 & P \text{ longer than } t^{\max}_r   \tag{10}

In the paper every route passes through every turbine, which more than one route cannot do
without visiting twice; here (3) asks for each turbine on exactly one route, (4) lets a route
leave what it reached, and (2) lets a route stay on the ground, so that the number of routes is
a decision between 1 and the number of turbines. Because of (3), the subtour rows (7) may be
summed over routes, which is stronger than one row for each.

Exchanging two routes of a station changes nothing but their numbers. (8) and (9) leave few of
those copies: sorted by their smallest turbine, the m-th route visits none of the first
:math:`m - 1`.

(7) has exponentially many rows, and (10) takes the routes that are too long by less than the
solver's tolerance; :meth:`RouteIndexed.cuts` gives only those that a solution violates.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import ArrayLike, NDArray

from formulations.flights import arcs_of, flights
from formulations.network import Network, network
from formulations.rows import fix
from formulations.subtours import inflow_row, violated_sets


@dataclass(frozen=True)
class RouteIndexed:
    """The program without its rows (7) and (10), and the arcs it chooses."""

    model: highspy.Highs
    x: HighspyArray  # (routes of all stations, n + 1, n + 1)
    station: NDArray[np.intp]  # of each route
    arcs: Network
    flown: NDArray[np.bool_]  # of the shape of x: arcs that (8) and the time leave over
    start: NDArray[np.float64] | None  # each turbine on a route of its own, if there are as many

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield the rows (7) that ``x``, fractional or not, violates; if none, the rows (10)."""
        whole = np.array_equal(x, np.rint(x))
        subtours = list(violated_sets(x.sum(axis=0)))
        for S in subtours:
            yield inflow_row(self.x, S, self.flown)
        if whole and not subtours:
            yield from self.arcs.long_flights(self.x, x, self.station.tolist())

    def routes(self, x: NDArray[np.float64]) -> list[tuple[int, tuple[int, ...]]]:
        """Return the flights of ``x``: each one's station and its turbines in order, from 0."""
        return [(int(d), f) for d, x_r in zip(self.station, x, strict=True) for f in flights(x_r)]

    def point(self, routes: Sequence[tuple[int, tuple[int, ...]]]) -> NDArray[np.float64]:
        """Return the ``x`` of flights, as :meth:`routes` gives them.

        Raises
        ------
        ValueError
            If a station flies more of them than it has routes.
        """
        x = np.zeros(self.x.shape)
        for d in {d for d, _ in routes}:
            sorted_by_smallest = sorted((f for station, f in routes if station == d), key=min)
            for r, f in zip(np.flatnonzero(self.station == d), sorted_by_smallest, strict=False):
                x[r] = arcs_of(f, x.shape[1] - 1)
        if x[:, 0].sum() < len(routes):
            raise ValueError(f"Expected no more routes than the program has, got {len(routes)}.")
        return x


def route_indexed(
    t: NDArray[np.float64],
    t_max: ArrayLike,
    *,
    routes: int | None = None,
    allowed: NDArray[np.bool_] | None = None,
) -> RouteIndexed:
    """Build the program (1)-(6), (8), (9).

    Parameters
    ----------
    t
        Time from leaving i until done at j, inspection included [s], shape
        ``(k, n + 1, n + 1)``, or ``(n + 1, n + 1)`` for one station; ``inf`` where the leg cannot
        be flown.
    t_max
        Longest flight of each station's UAV [s], shape ``(k,)`` or one for all.
    routes
        Routes that each station may fly at most; as many as there are turbines by default, which
        never excludes the best plan but makes for many variables.
    allowed
        Whether station d may serve turbine i, shape ``(k, n)``; all by default.

    Raises
    ------
    ValueError
        If ``routes`` is less than 1, or as :func:`formulations.network.network` does.
    """
    arcs = network(t, t_max, allowed)
    k, n = len(arcs.t), arcs.t.shape[1] - 1
    M = n if routes is None else min(routes, n)
    if routes is not None and routes < 1:
        raise ValueError(f"Expected routes >= 1, got {routes}.")
    station = np.repeat(np.arange(k), M)
    nth = np.tile(np.arange(M), k)
    R, N = range(len(station)), range(1, n + 1)
    open_to = (np.arange(n + 1) > nth[:, None]) | (np.arange(n + 1) == 0)  # (8)
    flown = arcs.flown[station] & open_to[:, :, None] & open_to[:, None, :]
    seconds, tau = np.where(flown, arcs.t[station], 0.0), np.where(flown, arcs.tau[station], 0.0)

    model = highspy.Highs()
    model.silent()
    x = model.addBinaries(len(station), n + 1, n + 1)  # (6)
    fix(model, x[~flown], 0.0)  # (8)

    model.addConstrs(x[r, 0].sum() <= 1 for r in R)  # (2)
    model.addConstrs(x[:, :, j].sum() == 1 for j in N)  # (3)
    model.addConstrs(x[r, :, j].sum() == x[r, j].sum() for r in R for j in N)  # (4)
    model.addConstrs((tau[r] * x[r]).sum() <= x[r, 0].sum() for r in R)  # (5)
    model.addConstrs(x[r, 0].sum() >= x[r + 1, 0].sum() for r in R[:-1] if nth[r + 1] > 0)  # (9)

    model.setObjective((seconds * x).sum(), highspy.ObjSense.kMinimize)  # (1)
    return RouteIndexed(model, x, station, arcs, flown, _alone(arcs, M))


def _alone(arcs: Network, M: int) -> NDArray[np.float64] | None:
    """Return each turbine on a route of its own, or nothing if a station needs more than M."""
    k, nodes, _ = arcs.t.shape
    x = np.zeros((k, M, nodes, nodes))
    for d, single in enumerate(arcs.alone):
        turbines = np.flatnonzero(single[0])
        if len(turbines) > M:
            return None
        m = np.arange(len(turbines))
        x[d, m, 0, turbines] = x[d, m, turbines, 0] = 1.0
    return x.reshape(k * M, nodes, nodes)
