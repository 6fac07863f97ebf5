r"""By how much few flights that serve a set of turbines last too long: a relaxation.

Nodes :math:`V = \{0, \dots, n\}` are all stations, merged, and the turbines; :math:`x_{ij}` tells
how much of the flights goes from i to j, and :math:`m` how many flights there may be, of
:math:`t^{\max}` each.

.. math::

    \min_x \quad & \sum_{ij} t_{ij} x_{ij} - t^{\max} \sum_j x_{0j}              \tag{1} \\
    \text{s.t.} \quad & \sum_i x_{ij} = 1              & j \in V \setminus 0       \tag{2} \\
      & \sum_j x_{ij} = 1                              & i \in V \setminus 0       \tag{3} \\
      & 1 \le \sum_j x_{0j} \le m                                                 \tag{4} \\
      & \sum_{i \notin S} \sum_{j \in S} x_{ij} \ge 1  & S \subseteq V \setminus 0 \tag{5} \\
      & x_{ij} \ge 0                                                              \tag{6}

Where its value is positive, m flights do not serve the turbines. (5) has exponentially many rows:
:func:`formulations.subtours.violated_sets` finds those that matter.
Unlike :mod:`formulations.one_flight`, which tries the orders of few turbines, this leaves some
questions open, but it answers for dozens of turbines, and for several flights.
"""

from dataclasses import dataclass

import highspy
import numpy as np
from numpy.typing import NDArray

from formulations.subtours import Nodes, violated_sets

INF = highspy.kHighsInf


@dataclass(frozen=True)
class FewFlights:
    """The program without its rows (5).

    Attributes
    ----------
    n
        Number of turbines.
    tail, head
        The ends of each leg that can be flown, shape ``(legs,)``; legs are the columns.
    """

    model: highspy.Highs
    n: int
    tail: NDArray[np.intp]
    head: NDArray[np.intp]

    def flows(self) -> NDArray[np.float64]:
        """Return how much flies each leg in the last solution, shape ``(n + 1, n + 1)``."""
        x = np.zeros((self.n + 1, self.n + 1))
        x[self.tail, self.head] = self.model.getSolution().col_value
        return x

    def cut(self) -> int:
        """Add the rows (5) that the last solution violates, and return how many."""
        sets: list[Nodes] = list(violated_sets(self.flows()))
        for S in sets:
            within = np.isin(np.arange(self.n + 1), S)
            legs = np.flatnonzero(~within[self.tail] & within[self.head]).astype(np.int32)
            self.model.addRow(1.0, INF, len(legs), legs, np.ones(len(legs)))
        return len(sets)


def few_flights(t: NDArray[np.float64], t_max: float, m: int) -> FewFlights:
    """Build the program (1)-(4), (6).

    Parameters
    ----------
    t
        Least time from i to j by any way, shape ``(n + 1, n + 1)``, since flights may call at other
        turbines as well; ``inf`` where there is none, which may leave the program infeasible.
    t_max
        Longest flight.
    m
        Most flights.
    """
    n = len(t) - 1
    model = highspy.Highs()
    model.silent()
    tail, head = np.nonzero(np.isfinite(t) & ~np.eye(n + 1, dtype=bool))
    for cost in t[tail, head] - np.where(tail == 0, t_max, 0.0):
        model.addCol(cost, 0.0, INF, 0, np.array([], np.int32), np.array([]))  # (1), (6)
    for ends in (head, tail):  # (2) and (3), and (4)
        for i in range(n + 1):
            there = np.flatnonzero(ends == i).astype(np.int32)
            model.addRow(1.0, 1.0 if i else float(m), len(there), there, np.ones(len(there)))
    return FewFlights(model, n, tail, head)
