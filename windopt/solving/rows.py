"""The rows of a HiGHS model as a matrix, and how well a solution keeps them.

HiGHS has called solutions optimal that were not feasible, so none is believed unchecked.
"""

from dataclasses import dataclass

import highspy
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array


@dataclass(frozen=True)
class Rows:
    """Rows and bounds of columns, copied, so that HiGHS may run while they are looked at."""

    A: csr_array[np.float64, tuple[int, int]]
    row_lower: NDArray[np.float64]
    row_upper: NDArray[np.float64]
    col_lower: NDArray[np.float64]
    col_upper: NDArray[np.float64]

    def largest_violation(self, values: NDArray[np.float64]) -> float:
        """Return by how much ``values``, one for each column, break a row or a bound at worst."""
        row = self.A @ values
        excess = (
            self.row_lower - row,
            row - self.row_upper,
            self.col_lower - values,
            values - self.col_upper,
        )
        return max(float(e.max(initial=0.0)) for e in excess)


def rows(lp: highspy.HighsLp) -> Rows:
    """Return the rows that ``lp`` has now."""
    limits = lp.row_lower_, lp.row_upper_, lp.col_lower_, lp.col_upper_
    return Rows(matrix(lp), *(np.array(limit) for limit in limits))


def matrix(lp: highspy.HighsLp) -> csr_array[np.float64, tuple[int, int]]:
    """Return the coefficients of all rows."""
    A = lp.a_matrix_
    form = csr_array if A.format_ == highspy.MatrixFormat.kRowwise else csc_array
    return csr_array(form((A.value_, A.index_, A.start_), shape=(lp.num_row_, lp.num_col_)))
