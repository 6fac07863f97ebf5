r"""The network in integers, the same to the last bit wherever it runs.

Inputs, states, gates and cells are fixed-point integers, and the weights are integers times a unit
already. For each gate, with W, U and the state h as integers,

.. math::

    A_t = U h_{t-1} + P_t, \qquad P_t = \lfloor (r \, W x_t + \beta) / 2^{16} + \tfrac12 \rfloor

counts its argument in units of (unit of U) / ONE; r and beta bring inputs and bias into these
units, for all steps at once. A table then gives the logistic function or the tanh of A, and

.. math::

    c_t = \lfloor (f_t c_{t-1} + i_t g_t) / \mathrm{ONE} + \tfrac12 \rfloor, \qquad
    h_t = \lfloor o_t \tanh(c_t) / \mathrm{ONE} + \tfrac12 \rfloor .

Sums over the states run through floating-point BLAS: where no sum can reach 2^24 (float32) or 2^53
(float64), floating point is integer arithmetic, and far quicker than NumPy's integer products.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.forecasting.network import QuantisedWeights, Single
from windopt.forecasting.quantisation import Quantised

ONE_BITS = 12
ONE = 1 << ONE_BITS  # what gates, cells and states count 1 as
INPUT_ONE = 1 << 8  # what inputs count 1 as
INPUT_LIMIT = 8  # standard deviations at which inputs are cut
FINE_BITS = 16  # of r and beta
TABLE_STEP = 2.0**-9  # widest step between two entries of a table
CELL_BITS = 3  # of a cell that its table passes over: a step of 2^-9 too

Integers = NDArray[np.int64]


class _Gate:
    """One gate's matrices as integers, and its table."""

    def __init__(self, W: Quantised, U: Quantised, b: Single) -> None:
        self.W, self.U = W.integers.astype(np.int64), U.integers.astype(np.int64)
        self.unit = U.unit / ONE
        self.r = round((1 << FINE_BITS) * W.unit / INPUT_ONE / self.unit)
        self.beta = np.rint((1 << FINE_BITS) * b.astype(float) / self.unit).astype(np.int64)
        driven = np.abs(self.W).sum(axis=1) * INPUT_ONE * INPUT_LIMIT * self.r + np.abs(self.beta)
        states = np.abs(self.U).sum(axis=1) * ONE
        self.bound = int((states + (driven >> FINE_BITS)).max()) + 1
        self.shift = max(0, int(np.floor(np.log2(TABLE_STEP / self.unit))))
        self.half = (self.bound >> self.shift) + 1  # entries on either side of zero

    def table(self, *, tanh: bool) -> NDArray[np.int16]:
        """Values at the middle of each step of the argument, in ONEs."""
        middle = (np.arange(-self.half, self.half) + 0.5) * self.unit * (1 << self.shift)
        values = np.tanh(middle) if tanh else (1 + np.tanh(middle / 2)) / 2
        return np.rint(ONE * values).astype(np.int16)


class IntegerNetwork:
    """The network in integers.

    Parameters
    ----------
    weights
        Quantised to at most 8 bits.
    steps
        The longest history that the table of cells must hold, in steps.

    Raises
    ------
    InvalidInput
        If a matrix has more than 8 bits.
    """

    def __init__(self, weights: QuantisedWeights, steps: int = 64) -> None:
        if max(matrix.bits for matrix in weights.matrices) > 8:
            raise InvalidInput("bits", "at most 8 for integer arithmetic", "more")
        biases = np.split(weights.b, 4)
        i, f, g, o = (_Gate(*parts) for parts in zip(weights.W, weights.U, biases, strict=True))
        gates = (o, i, f, g)
        self._n, self._steps = len(o.U), steps
        bound = max(gate.bound for gate in gates)
        self.exact: type[np.floating] = np.float32 if bound < 1 << 24 else np.float64
        self._U = np.asfortranarray(np.concatenate([gate.U for gate in gates]), dtype=self.exact)
        self._W = np.concatenate([gate.W for gate in gates])
        self._r = np.repeat([gate.r for gate in gates], self._n)[:, None]
        self._beta = np.concatenate([gate.beta for gate in gates])[:, None]
        tables = [gate.table(tanh=gate is g) for gate in gates]
        self._table = np.concatenate(tables).astype(np.int64)
        starts = np.cumsum([0, *map(len, tables[:-1])])
        self._shift = np.repeat([gate.shift for gate in gates], self._n)[:, None]
        middle = starts + [gate.half for gate in gates]
        self._middle = np.repeat(middle, self._n)[:, None] << self._shift
        half = steps * ONE >> CELL_BITS  # a cell gains one at most in a step
        cells = (np.roll(np.arange(-half, half), half) + 0.5) / (ONE >> CELL_BITS)
        self._tanh = np.rint(ONE * np.tanh(cells)).astype(np.int64)  # wraps: -1 is the last entry
        self._W_y = weights.W_y.integers.astype(np.float64)
        self._unit_y, self._b_y = weights.W_y.unit / ONE, weights.b_y

    def __call__(self, x: Single) -> Single:
        """Return the outputs ``(B, m)`` for the inputs ``(B, L, d)``."""
        return (self._unit_y * self.sums(x) + self._b_y).astype(np.float32)

    def sums(self, x: Single) -> Integers:
        """Return the outputs as integers, before their unit and bias, shape ``(B, m)``.

        Raises
        ------
        InvalidInput
            If the history is longer than the table of cells allows.
        """
        (B, L, _), n = x.shape, self._n
        if self._steps < L:
            raise InvalidInput("history", f"of at most {self._steps} steps", L)
        many = (B,) if B > 1 else ()  # vectors are quicker than matrices of one column
        driven = self._driven(x).reshape(L, 4 * n, *many)
        shift = self._shift.reshape(4 * n, *[1] * len(many))
        total = np.zeros((4 * n, *many), dtype=self.exact)
        at, inner = np.empty(total.shape, np.int64), np.empty((n, *many), np.int64)
        z = np.zeros((5 * n, *many), dtype=np.int64)  # o, i, f, g and c
        product = np.empty((2 * n, *many), dtype=np.int64)
        pushed, kept = product[:n], product[n:]
        gates, o, c = z[: 4 * n], z[:n], z[4 * n :]
        left, right = z[n : 3 * n], z[3 * n :]  # (i, f) and (g, c)
        h = np.zeros((n, *many), dtype=self.exact)
        rounding = np.int64(ONE >> 1)
        for P in driven:
            np.dot(self._U, h, total)
            np.copyto(at, total, "unsafe")
            np.add(at, P, at)
            np.right_shift(at, shift, at)
            self._table.take(at, out=gates, mode="clip")
            np.multiply(left, right, product)
            np.add(pushed, kept, c)
            np.add(c, rounding, c)
            np.right_shift(c, ONE_BITS, c)
            np.right_shift(c, CELL_BITS, inner)
            self._tanh.take(inner, out=pushed, mode="wrap")
            np.multiply(o, pushed, inner)
            np.add(inner, rounding, inner)
            np.right_shift(inner, ONE_BITS, inner)
            np.copyto(h, inner, "unsafe")
        sums: Integers = (self._W_y @ h.reshape(n, B).astype(float)).astype(np.int64).T
        return sums

    def _driven(self, x: Single) -> Integers:
        """P of each step, with the middle of each gate's table added, shape ``(L, 4 n, B)``."""
        limit = INPUT_ONE * INPUT_LIMIT
        whole = np.clip(np.rint(INPUT_ONE * x.astype(float)), -limit, limit).astype(np.int64)
        sums = self._W @ whole.transpose(1, 2, 0)
        P = (self._r * sums + self._beta + (1 << (FINE_BITS - 1))) >> FINE_BITS
        driven: Integers = P + self._middle
        return driven
