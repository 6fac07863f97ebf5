"""The rows of a HiGHS model as a matrix, and how well a solution keeps them.

HiGHS has called solutions optimal that were not feasible, so none is believed unchecked.
"""

import highspy
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array


def largest_violation(model: highspy.Highs, values: NDArray[np.float64]) -> float:
    """Return by how much ``values`` break a row or a bound of ``model`` at worst.

    Parameters
    ----------
    values
        Value of every column.
    """
    lp = model.getLp()
    row = matrix(lp) @ values
    excess = (
        np.asarray(lp.row_lower_) - row,
        row - np.asarray(lp.row_upper_),
        np.asarray(lp.col_lower_) - values,
        values - np.asarray(lp.col_upper_),
    )
    return max(float(e.max(initial=0.0)) for e in excess)


def matrix(lp: highspy.HighsLp) -> csr_array[np.float64, tuple[int, int]]:
    """Return the coefficients of all rows."""
    A = lp.a_matrix_
    form = csr_array if A.format_ == highspy.MatrixFormat.kRowwise else csc_array
    return csr_array(form((A.value_, A.index_, A.start_), shape=(lp.num_row_, lp.num_col_)))
