r"""One closed tour through the station and all turbines, without a limit on its time.

Nodes :math:`V = \{0, \dots, n\}` with the station 0; :math:`x_{ij}` flies from i to j. Times are
asymmetric under wind. Algorithm 2 solves this program for each UAV and then splits the tour by
the time a battery lasts.

.. math::

    \min_x \quad & \sum_{ij} t_{ij} x_{ij}                                      \tag{1} \\
    \text{s.t.} \quad & \sum_j x_{ij} = 1                       & i \in V        \tag{2} \\
      & \sum_i x_{ij} = 1                                       & j \in V        \tag{3} \\
      & \sum_{i \notin S} \sum_{j \in S} x_{ij} \ge 1 & S \subseteq V \setminus 0 \tag{4} \\
      & x_{ij} \in \{0, 1\}                                                      \tag{5}

(4) has exponentially many rows, so :meth:`Tour.cuts` gives only those that a solution violates
(Dantzig, Fulkerson & Johnson 1954, *Operations Research* 2, 393-410).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import NDArray

from formulations.flights import flights
from formulations.subtours import inflow_row, violated_sets


@dataclass(frozen=True)
class Tour:
    """The program without its rows (4), and the arcs it chooses."""

    model: highspy.Highs
    x: HighspyArray  # (n + 1, n + 1)
    flown: NDArray[np.bool_]  # (n + 1, n + 1) arcs that can be flown
    start: NDArray[np.float64]  # (n + 1, n + 1) the turbines in the order they came

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield the rows (4) that ``x``, fractional or not, violates."""
        return (inflow_row(self.x, S, self.flown) for S in violated_sets(x))

    def routes(self, x: NDArray[np.float64]) -> list[tuple[int, tuple[int, ...]]]:
        """Return the tour as the one flight of station 0: its turbines in order, from 0."""
        return [(0, flight) for flight in flights(x)]


def tour(t: NDArray[np.float64]) -> Tour:
    """Build the program (1)-(3), (5).

    Parameters
    ----------
    t
        Time from leaving i until done at j [s], shape ``(n + 1, n + 1)``, at least one turbine;
        ``inf`` where the leg cannot be flown.
    """
    model = highspy.Highs()
    model.silent()
    V = range(len(t))
    flown = np.isfinite(t) & ~np.eye(len(t), dtype=bool)

    x = model.addBinaries(len(t), len(t))  # (5)

    model.addConstrs(x[i, flown[i]].sum() == 1 for i in V)  # (2)
    model.addConstrs(x[flown[:, j], j].sum() == 1 for j in V)  # (3)
    model.addConstrs(v == 0 for v in x[~flown])

    model.setObjective((t[flown] * x[flown]).sum(), highspy.ObjSense.kMinimize)  # (1)
    return Tour(model, x, flown, start=np.roll(np.eye(len(t)), 1, axis=1))
