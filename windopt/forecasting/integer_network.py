r"""The network in integers, the same to the last bit wherever it runs.

Inputs, states, gates and cells are fixed-point integers, and the weights are integers times a unit
already. For each gate, with W, U and the state h as integers,

.. math::

    A_t = U h_{t-1} + P_t, \qquad P_t = \lfloor (r \, W x_t + \beta) / 2^{16} + \tfrac12 \rfloor

counts its argument in units of (unit of U) / ONE; r and beta bring inputs and bias into these
units, for all steps at once. A table then gives the logistic function or the tanh of A, another the
tanh of the cell, and

.. math::

    c_t = \operatorname{rint} \frac{f_t c_{t-1} + i_t g_t}{\mathrm{ONE}}, \qquad
    h_t = \operatorname{rint} \frac{o_t \tanh c_t}{\mathrm{ONE}},

with ties to even. Every one of these integers runs through floating-point units, where it is far
quicker: below 2^24 in float32 and 2^53 in float64, floating point *is* integer arithmetic, also
of multiples of a power of two. The bounds are computed from the weights.
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
TABLE_STEP = 2.0**-9  # widest step between two entries of a gate's table

Integers = NDArray[np.int64]
Floats = NDArray[np.floating]  # of which every one is an integer, or that times a power of two


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

    def table(self, *, tanh: bool) -> Floats:
        """Values at the middle of each step of the argument: tanh in ONEs, else as fractions."""
        middle = (np.arange(-self.half, self.half) + 0.5) * self.unit * (1 << self.shift)
        values: Floats = np.tanh(middle) if tanh else (1 + np.tanh(middle / 2)) / 2
        return np.rint(ONE * values) / (1 if tanh else ONE)


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
        self._lay_tables(gates, g)
        self._W_y = weights.W_y.integers.astype(np.float64)
        self._unit_y, self._b_y = weights.W_y.unit / ONE, weights.b_y
        # P and A shifted to the entry of the gate's table: integers times powers of two
        self._scale = np.repeat([2.0**-gate.shift for gate in gates], self._n)
        U = self._scale[:, None] * np.concatenate([gate.U for gate in gates])
        self._U = np.asfortranarray(U, dtype=self.exact)
        fine = 2.0**-FINE_BITS
        self._W = fine * np.concatenate([gate.r * gate.W for gate in gates]).T
        self._beta = fine * np.concatenate([gate.beta for gate in gates]) + 0.5

    def _lay_tables(self, gates: tuple[_Gate, ...], g: _Gate) -> None:
        """Lay the gates' tables one after the other, and that of the cells."""
        tables = [gate.table(tanh=gate is g) for gate in gates]
        starts = np.cumsum([0, *map(len, tables[:-1])])
        self._table, self._start = np.concatenate(tables), np.repeat(starts, self._n)
        self._half = np.repeat([gate.half for gate in gates], self._n)
        largest = max(gate.half << gate.shift for gate in gates) << 1
        self.exact: type[np.floating] = np.float32 if largest < 1 << 24 else np.float64
        cells = np.arange(-self._steps * ONE, self._steps * ONE + 1)  # gains one at most in a step
        tanh = np.rint(ONE * np.tanh(cells / ONE))
        self._tanh = np.roll(tanh, len(cells) // 2 + 1)  # wraps: -1 is the last entry

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
        total, h = (np.zeros((rows, *many), dtype=self.exact) for rows in (4 * n, n))
        at, cell = (np.empty((rows, *many), dtype=np.intp) for rows in (4 * n, n))
        start = self._start.reshape(4 * n, *[1] * len(many))
        z = np.zeros((5 * n, *many))  # o, i, f, g and c
        product = np.empty((2 * n, *many))
        pushed, kept = product[:n], product[n:]
        gates, o, c = z[: 4 * n], z[:n], z[4 * n :]
        left, right = z[n : 3 * n], z[3 * n :]  # (i, f) and (g, c)
        for P in self._driven(x).reshape(L, 4 * n, *many):
            np.dot(self._U, h, total)
            np.add(total, P, total)
            np.copyto(at, total, "unsafe")  # cuts off what the shift leaves behind the point
            np.add(at, start, at)
            self._table.take(at, out=gates, mode="clip")
            np.multiply(left, right, product)
            np.add(pushed, kept, c)
            np.rint(c, c)
            np.copyto(cell, c, "unsafe")
            self._tanh.take(cell, out=pushed, mode="wrap")
            np.multiply(o, pushed, pushed)
            np.rint(pushed, h)
        sums: Integers = (self._W_y @ h.reshape(n, B).astype(float)).astype(np.int64).T
        return sums

    def _driven(self, x: Single) -> Floats:
        """P of each step, shifted and counted from its table's start, shape ``(L, 4 n, B)``."""
        limit = INPUT_ONE * INPUT_LIMIT
        whole = np.clip(np.rint(INPUT_ONE * x.astype(float)), -limit, limit)
        P = np.floor(whole @ self._W + self._beta)
        driven: Floats = (self._scale * P + self._half).astype(self.exact)
        return np.ascontiguousarray(driven.transpose(1, 2, 0))
