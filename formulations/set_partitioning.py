r"""Inspection by set partitioning: choose among flights that are known in advance.

Flight r of the set :math:`R` takes the time :math:`c_r`, visits turbine i :math:`a_{ir}` times
and starts from station :math:`d(r)`; :math:`x_r` says whether it is flown, and :math:`y_i`
whether turbine i is left out at a price :math:`p_i`.

.. math::

    \min_{x, y} \quad & \sum_{r \in R} c_r x_r + \sum_i p_i y_i                   \tag{1} \\
    \text{s.t.} \quad & \sum_r a_{ir} x_r + y_i = 1 & i = 1, \dots, n               \tag{2} \\
      & l_d \le \sum_{r : d(r) = d} x_r \le u_d & d = 1, \dots, k                   \tag{3} \\
      & l_0 \le \sum_r x_r \le u_0                                                  \tag{4} \\
      & \sum_r \Bigl\lfloor \tfrac12 \sum_{i \in S} a_{ir} \Bigr\rfloor x_r \le 1
        & |S| = 3                                                                   \tag{5} \\
      & \sum_r e_{rS} x_r + \kappa(S) \sum_{i \in S} y_i \ge \kappa(S)
        & S \text{ needs } \kappa(S) \text{ flights}                                 \tag{6} \\
      & x_r, y_i \in \{0, 1\}                                                       \tag{7}

Where flights obey the triangle inequality (2) may read :math:`\ge 1`, and its relaxation is then
the master of column generation: flights are added as they are found, by
:meth:`SetPartitioning.add_flights`. (5) follows from (2) and (7) and cuts off fractional plans
[1]; there are :math:`n^3 / 6` such rows, so they too are added as they are violated. So are
the rows (6): flight r enters the set S :math:`e_{rS}` times, and fewer than :math:`\kappa(S)`
flights cannot serve all of S in time [2].

* [1] Jepsen, Petersen, Spoorendonk & Pisinger (2008), *Operations Research* 56, 497-511.
* [2] Kohl, Desrosiers, Madsen, Solomon & Soumis (1999), *Transportation Science* 33, 101-116.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

import highspy
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csc_array, csr_array

INF = highspy.kHighsInf

Indices: TypeAlias = NDArray[np.int32]


@dataclass
class SetPartitioning:
    """The program of the flights added so far, to which rows come and from which they go.

    Attributes
    ----------
    model
        The rows (2)-(4) come first.
    n, k
        Number of turbines and of stations.
    integer
        Whether (7) holds, or only x >= 0.
    subset_rows, entry_rows
        Which rows are (5) and which (6).
    """

    model: highspy.Highs
    n: int
    k: int
    integer: bool
    subset_rows: Indices = field(init=False)
    entry_rows: Indices = field(init=False)

    def __post_init__(self) -> None:
        self.subset_rows = self.entry_rows = np.zeros(0, np.int32)

    @property
    def rows(self) -> Indices:
        """The rows in the order of the equations."""
        first = np.arange(self.n + self.k + 1, dtype=np.int32)
        return np.concatenate([first, self.subset_rows, self.entry_rows])

    def by_equation(self, row: ArrayLike) -> list[NDArray[np.float64]]:
        """Split values of the rows into those of (2), of (3) and (4), of (5) and of (6)."""
        first = self.n + self.k + 1
        ends = [self.n, first, first + len(self.subset_rows)]
        return np.split(np.asarray(row)[self.rows], ends)

    def add_flights(self, c: NDArray[np.float64], a: csc_array) -> None:
        """Add one column per flight.

        Parameters
        ----------
        c
            Time of each flight, shape ``(m,)``.
        a
            Coefficients in all rows, in the order of the equations, shape ``(rows, m)``.
        """
        before, m = self.model.getNumCol(), len(c)
        upper = np.full(m, 1.0 if self.integer else INF)
        starts, rows = a.indptr[:-1].astype(np.int32), self.rows[a.indices]
        self.model.addCols(m, c, np.zeros(m), upper, a.nnz, starts, rows, a.data)  # (1), (7)
        if self.integer:
            kinds = np.full(m, int(highspy.HighsVarType.kInteger), np.uint8)
            columns = np.arange(before, before + m, dtype=np.int32)
            self.model.changeColsIntegrality(m, columns, kinds)

    def add_subset_rows(self, a: csr_array) -> None:
        """Add rows (5) with the coefficients ``a``, shape ``(m, flights)``."""
        m = a.shape[0]
        new = self._add_rows(np.full(m, -INF), np.ones(m), a)  # (5)
        self.subset_rows = np.append(self.subset_rows, new)

    def add_entry_rows(self, a: csr_array, need: NDArray[np.float64]) -> None:
        """Add rows (6) with the coefficients ``a``, shape ``(m, columns)``, and right sides."""
        new = self._add_rows(need, np.full(len(need), INF), a)  # (6)
        self.entry_rows = np.append(self.entry_rows, new)

    def keep_subset_rows(self, keep: NDArray[np.bool_]) -> None:
        """Delete the rows (5) where ``keep`` does not hold."""
        gone, self.subset_rows = self.subset_rows[~keep], self.subset_rows[keep]
        self._delete_rows(gone)

    def keep_entry_rows(self, keep: NDArray[np.bool_]) -> None:
        """Delete the rows (6) where ``keep`` does not hold."""
        gone, self.entry_rows = self.entry_rows[~keep], self.entry_rows[keep]
        self._delete_rows(gone)

    def _delete_rows(self, gone: Indices) -> None:
        """Delete rows, and number the others anew."""
        self.model.deleteRows(len(gone), gone)
        self.subset_rows = _renumbered(self.subset_rows, gone)
        self.entry_rows = _renumbered(self.entry_rows, gone)

    def _add_rows(
        self, lower: NDArray[np.float64], upper: NDArray[np.float64], a: csr_array
    ) -> Indices:
        """Add rows, and return which they are."""
        before, m = self.model.getNumRow(), len(lower)
        starts, columns = a.indptr[:-1].astype(np.int32), a.indices.astype(np.int32)
        self.model.addRows(m, lower, upper, a.nnz, starts, columns, a.data)
        return np.arange(before, before + m, dtype=np.int32)


def _renumbered(rows: Indices, gone: Indices) -> Indices:
    """Return the numbers of ``rows`` once the rows ``gone`` are deleted; both increase."""
    return rows - np.searchsorted(gone, rows).astype(np.int32)


def set_partitioning(
    n: int,
    counts: NDArray[np.float64],
    *,
    integer: bool = True,
    cover: bool = False,
    price: ArrayLike | None = None,
) -> SetPartitioning:
    """Build the rows (2)-(4); flights come later.

    Parameters
    ----------
    n
        Number of turbines.
    counts
        Least and largest number of flights of each station, and of all; shape ``(k + 1, 2)``.
    integer
        Whether to ask for (7), or for x >= 0 only.
    cover
        Whether (2) reads >= 1.
    price
        The price p of leaving each turbine out, shape ``(n,)`` or one for all; None where none
        may be left out. The first n columns are then y.
    """
    model = highspy.Highs()
    model.silent()
    nothing = np.array([], np.int32)
    for _ in range(n):
        model.addRow(1.0, INF if cover else 1.0, 0, nothing, np.array([]))  # (2)
    for lower, upper in counts:
        model.addRow(float(lower), float(upper), 0, nothing, np.array([]))  # (3), (4)
    program = SetPartitioning(model, n, len(counts) - 1, integer)
    if price is not None:
        each = np.arange(n)
        program.add_flights(
            np.broadcast_to(np.asarray(price, float), n).copy(),
            csc_array((np.ones(n), (each, each)), shape=(n + len(counts), n)),
        )  # y
    return program
