r"""The network with sparse matrices, in the two ways in which quantised weights can be sparse.

(a) Levels that are symmetric around zero without containing it (``Levels.HALF``) are affine in
unsigned codes C, of which a fifth to a third are zero, and

.. math::

    W x = s \bigl( \tfrac{1}{q} C x - \tfrac12 \textstyle\sum_j x_j \bigr),

so C is stored sparse and its constant row is subtracted once.

(b) Levels with a zero (``Levels.ZERO``) give a sparse matrix as they are.

Neither is quicker than a dense product until about nine weights in ten are zero; they are here
because the paper computes so, and to be measured.
"""

import numpy as np
from scipy.sparse import csr_array

from windopt.forecasting.network import QuantisedWeights, Single
from windopt.forecasting.quantisation import Levels, Quantised, largest_code


class SparseMatrix:
    """A quantised matrix that multiplies by its non-zero codes.

    Parameters
    ----------
    quantised
        Of either set of levels.
    """

    def __init__(self, quantised: Quantised) -> None:
        largest = largest_code(quantised.bits, quantised.levels)
        if quantised.levels is Levels.HALF:
            codes, self._half = quantised.codes.astype(np.float32), np.float32(quantised.s / 2)
            self._unit = np.float32(quantised.s / largest)
        else:
            codes, self._half = quantised.integers.astype(np.float32), np.float32(0)
            self._unit = np.float32(quantised.unit)
        self._codes = csr_array(codes)

    @property
    def zeros(self) -> float:
        """Fraction of codes that are zero and not stored [-]."""
        rows, columns = self._codes.shape
        return float(1 - self._codes.nnz / (rows * columns))

    def __matmul__(self, x: Single) -> Single:
        """Return the product with ``x`` of shape ``(columns, B)``."""
        y: Single = self._unit * (self._codes @ x)
        return y - self._half * x.sum(axis=0) if self._half else y


class SparseNetwork:
    """The network in float32 with sparse products."""

    def __init__(self, weights: QuantisedWeights) -> None:
        self._W = [SparseMatrix(gate) for gate in weights.W]
        self._U = [SparseMatrix(gate) for gate in weights.U]
        self._W_y = SparseMatrix(weights.W_y)
        self._b = [gate[:, None] for gate in np.split(weights.b, 4)]
        self._b_y = weights.b_y[:, None]

    @property
    def zeros(self) -> float:
        """Mean fraction of zeros over the recurrent matrices, the largest [-]."""
        return sum(gate.zeros for gate in self._U) / 4

    def __call__(self, x: Single) -> Single:
        """Return the outputs ``(B, m)`` for the inputs ``(B, L, d)``."""
        n = len(self._b[0])
        h = np.zeros((n, len(x)), dtype=np.float32)
        c = np.zeros_like(h)
        for step in x.transpose(1, 2, 0):
            now = np.ascontiguousarray(step)
            i, f, g, o = (
                W @ now + U @ h + b for W, U, b in zip(self._W, self._U, self._b, strict=True)
            )
            c = _logistic(f) * c + _logistic(i) * np.tanh(g)
            h = _logistic(o) * np.tanh(c)
        y: Single = (self._W_y @ h + self._b_y).T
        return y


def _logistic(z: Single) -> Single:
    """1 / (1 + exp(-z)), without overflow."""
    y: Single = 0.5 + 0.5 * np.tanh(0.5 * z)
    return y
