r"""Inspection routing with the flight time as a flow: two indices and a station per arc.

Stations :math:`d = 1, \dots, k`, each with its own copy of the nodes
:math:`V = \{0, \dots, n\}`: 0 is the station itself, the others are the turbines
:math:`N = V \setminus 0`. :math:`x_{dij}` flies from i to j out of station d, and
:math:`f_{dij}` is the time since take-off on being done at j, as a fraction of
:math:`t^{\max}_d`; so is :math:`\tau_{dij}`, the time :math:`t_{dij}` of the leg.

.. math::

    \min_{x, f} \quad & \sum_{dij} t_{dij} x_{dij}                               \tag{1} \\
    \text{s.t.} \quad & \sum_{di} x_{dij} = 1                       & j \in N    \tag{2} \\
      & \sum_i x_{dij} = \sum_i x_{dji}                          & d,\ j \in N   \tag{3} \\
      & \sum_i f_{dji} = \sum_i f_{dij} + \sum_i \tau_{dji} x_{dji} & d,\ j \in N \tag{4} \\
      & (\alpha_{di} + \tau_{dij}) x_{dij} \le f_{dij} \le (1 - \omega_{dj}) x_{dij} \tag{5} \\
      & f_{d0j} = \tau_{d0j} x_{d0j}                                              \tag{6} \\
      & \sum_{dj} x_{d0j} = m                                                     \tag{7} \\
      & \sum_d \sum_{i \notin S} \sum_{j \in S} x_{dij} \ge r(S) & S \subseteq N  \tag{8} \\
      & \sum_{ij \in P} x_{dij} \le |P| - 1 & P \text{ longer than } t^{\max}_d   \tag{9} \\
      & x_{dij} \in \{0, 1\}, \quad m \in \mathbb{N}                              \tag{10}

:math:`\alpha_{di}` and :math:`\omega_{dj}` are the least times from the station to i and from j
back to it, as fractions; they are shortest paths, so (5) holds whether or not times obey the
triangle inequality. An arc with :math:`\alpha_{di} + \tau_{dij} + \omega_{dj} > 1` is on no
flight: it has neither :math:`f` nor rows, and its :math:`x` is fixed to 0. Each station keeps its
own arcs because a flight must return to where it left from, and because UAVs may differ.

The rest is there for the proof. The number of flights :math:`m` gives the search something to
branch on that decides much at once. In (8), :math:`r(S)` is 2 where no single flight can serve S,
by whatever detour (:mod:`formulations.one_flight`), and 1 elsewhere: it tightens the relaxation;
(4)-(6) alone rule out long flights and, where legs take time, subtours. (9) takes the flights that
are too long by less than the solver's tolerance. (8) and (9) have exponentially many rows, so
:meth:`TimeFlow.cuts` gives only those that a solution violates. The flow goes back to Gavish &
Graves (1978), MIT Operations Research Center working paper 078-78.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array, diags_array

from formulations.flights import arcs_of, flights
from formulations.network import Network, network
from formulations.one_flight import OneFlight
from formulations.rows import Matrix, add_rows, columns, fix
from formulations.subtours import inflow_row, violated_sets


@dataclass(frozen=True)
class TimeFlow:
    """The program without its rows (8) and (9), and the arcs it chooses."""

    model: highspy.Highs
    x: HighspyArray  # (k, n + 1, n + 1)
    f: HighspyArray  # one for each arc that fits into a flight
    arcs: Network
    one_flight: OneFlight
    start: NDArray[np.float64]  # (k, n + 1, n + 1) each turbine on a flight of its own

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield the rows (8) that ``x`` violates, and the rows (9) if it is whole."""
        merged, whole = x.sum(axis=0), np.array_equal(x, np.rint(x))
        subtours = list(violated_sets(merged))
        for S in subtours:
            yield inflow_row(self.x, S, self.arcs.flown)
        if not whole:
            for S in self.one_flight.crowded_sets(merged):
                yield inflow_row(self.x, S, self.arcs.flown, least=2)
        elif not subtours:
            yield from self.arcs.long_flights(self.x, x, range(len(x)))

    def routes(self, x: NDArray[np.float64]) -> list[tuple[int, tuple[int, ...]]]:
        """Return the flights of ``x``: each one's station and its turbines in order, from 0."""
        return [(d, flight) for d in range(len(x)) for flight in flights(x[d])]

    def point(self, routes: Sequence[tuple[int, tuple[int, ...]]]) -> NDArray[np.float64]:
        """Return the ``x`` of flights, as :meth:`routes` gives them."""
        x = np.zeros(self.x.shape)
        for d, flight in routes:
            x[d] += arcs_of(flight, x.shape[1] - 1)
        return x


def time_flow(
    t: NDArray[np.float64], t_max: ArrayLike, *, allowed: NDArray[np.bool_] | None = None
) -> TimeFlow:
    """Build the program (1)-(7), (10).

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

    Raises
    ------
    ValueError
        As :func:`formulations.network.network` does.
    """
    arcs = network(t, t_max, allowed)
    k, n = len(arcs.t), arcs.t.shape[1] - 1
    d, i, j = np.nonzero(arcs.flown)
    tau = arcs.tau[d, i, j]
    earliest = arcs.alpha[d, i] + tau
    latest = np.where(i == 0, tau, 1.0 - arcs.omega[d, j])
    visit = incidence(j - 1, j > 0, n)
    enter = incidence(d * n + j - 1, j > 0, k * n)
    leave = incidence(d * n + i - 1, i > 0, k * n)
    one = np.ones(len(d))

    model = highspy.Highs()
    model.silent()
    x_all = model.addBinaries(k, n + 1, n + 1)  # (10)
    f = model.addVariables(len(d))
    x = x_all[d, i, j]
    fix(model, x_all[~arcs.flown], 0.0)

    add_rows(model, (visit, x), lower=1.0, upper=1.0)  # (2)
    add_rows(model, (enter - leave, x), lower=0.0, upper=0.0)  # (3)
    add_rows(model, (leave - enter, f), (leave @ diagonal(-tau), x), lower=0.0, upper=0.0)  # (4)
    add_rows(model, (diagonal(one), f), (diagonal(-earliest), x), lower=0.0)  # (5), (6)
    add_rows(model, (diagonal(one), f), (diagonal(-latest), x), upper=0.0)
    model.addConstr(x[i == 0].sum() == model.addIntegral())  # (7)

    model.changeColsCost(len(d), columns(x), arcs.t[d, i, j])  # (1)
    return TimeFlow(model, x_all, f, arcs, OneFlight(arcs), start=arcs.alone)


def incidence(row: NDArray[np.intp], member: NDArray[np.bool_], m: int) -> Matrix:
    """Return the matrix, shape ``(m, arcs)``, that sums arcs which are members by their row."""
    arc = np.flatnonzero(member)
    return csr_array((np.ones(len(arc)), (row[arc], arc)), shape=(m, len(member)))


def diagonal(v: NDArray[np.float64]) -> Matrix:
    """Return the matrix that multiplies each arc by its entry of ``v``."""
    return csr_array(diags_array(v))
