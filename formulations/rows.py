"""Whole blocks of rows at once, as a sparse matrix times an array of variables.

:mod:`formulations.time_flow` has two rows for each arc, hundreds of thousands on a large farm;
written one expression each they take minutes. Small programs read better as expressions.
"""

from math import inf
from typing import TypeAlias

import highspy
import numpy as np
from highspy.highs import HighspyArray
from numpy.typing import NDArray
from scipy.sparse import csr_array

Matrix: TypeAlias = csr_array[np.float64, tuple[int, int]]


def add_rows(
    model: highspy.Highs,
    *terms: tuple[Matrix, HighspyArray],
    lower: float = -inf,
    upper: float = inf,
) -> None:
    """Add the rows ``lower <= sum of A @ v <= upper`` over the terms ``(A, v)``.

    Parameters
    ----------
    terms
        Matrices of shape ``(m, len(v))`` and the variables they apply to.
    lower, upper
        Limits of all m rows.
    """
    m, n = terms[0][0].shape[0], model.getNumCol()
    A = csr_array((m, n))
    for matrix, v in terms:
        A = A + _spread(matrix, v, n)
    model.addRows(m, np.full(m, lower), np.full(m, upper), A.nnz, A.indptr[:-1], A.indices, A.data)


def fix(model: highspy.Highs, v: HighspyArray, value: float) -> None:
    """Fix all variables ``v`` to ``value``."""
    values = np.full(v.size, value)
    model.changeColsBounds(v.size, columns(v), values, values)


def columns(v: HighspyArray) -> NDArray[np.int32]:
    """Return the columns of the variables ``v``, in order."""
    return np.fromiter((variable.index for variable in v.flat), np.int32, v.size)


def _spread(A: Matrix, v: HighspyArray, n: int) -> Matrix:
    """Return ``A`` with its columns moved to those of ``v`` among all n of the model."""
    return csr_array((A.data, columns(v)[A.indices], A.indptr), shape=(A.shape[0], n))
