r"""The network: one LSTM layer and a linear output, in floating point, NumPy only.

.. math::

    f_t, i_t, o_t &= \sigma(W x_t + U h_{t-1} + b)                                    \\
    c_t &= f_t \circ c_{t-1} + i_t \circ \tanh(W_c x_t + U_c h_{t-1} + b_c)           \\
    h_t &= o_t \circ \tanh(c_t), \qquad \hat y = W_y h_L + b_y

The gates are stacked in the order i, f, c, o. As :math:`\sigma(z) = (1 + \tanh(z / 2)) / 2`, one
tanh over all of them replaces three logistic functions, and every step works in place: at batch
size 1 the calls cost as much as the arithmetic.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.forecasting.quantisation import FLOAT, GAMMA, Levels, Quantised, quantise

Single = NDArray[np.float32]
Network = Callable[[Single], Single]  # inputs (B, L, d) -> outputs (B, m)


@dataclass(frozen=True)
class Weights:
    """What training finds, shapes for d inputs, n units and m outputs.

    Parameters
    ----------
    W, U, b
        Of the gates i, f, c, o: from the inputs ``(4 n, d)``, from the state ``(4 n, n)``, and
        constant ``(4 n,)``.
    W_y, b_y
        Of the output, ``(m, n)`` and ``(m,)``.
    """

    W: Single
    U: Single
    b: Single
    W_y: Single
    b_y: Single

    def __post_init__(self) -> None:
        n, d, m = self.units, self.W.shape[1], len(self.b_y)
        for name, array, shape in (
            ("W", self.W, (4 * n, d)),
            ("U", self.U, (4 * n, n)),
            ("b", self.b, (4 * n,)),
            ("W_y", self.W_y, (m, n)),
        ):
            if array.shape != shape:
                raise InvalidInput(f"weights {name}", f"of shape {shape}", array.shape)
            if not np.isfinite(array).all():
                raise InvalidInput(f"weights {name}", "to be finite", "NaN or infinity")

    @property
    def units(self) -> int:
        """Number of hidden units n."""
        return int(self.U.shape[1])

    def quantised(
        self,
        bits: int,
        output_bits: int | None = None,
        *,
        levels: Levels = Levels.HALF,
        gamma: float = GAMMA,
    ) -> "QuantisedWeights":
        """Quantise the eight gate matrices, each with a scale of its own, and the output's.

        Parameters
        ----------
        bits, output_bits
            omega_w and omega_f, both below 32; the second is the first if left out.
        """
        blocks = (*np.split(self.W, 4), *np.split(self.U, 4))
        gates = tuple(quantise(block, bits, levels=levels, gamma=gamma) for block in blocks)
        y = quantise(self.W_y, output_bits or bits, levels=levels, gamma=gamma)
        b, b_y = self.b, self.b_y
        if max(bits, output_bits or bits) <= 8:  # their own rounding drowns in the weights'
            b, b_y = (bias.astype(np.float16).astype(np.float32) for bias in (b, b_y))
        return QuantisedWeights(gates[:4], gates[4:], b, y, b_y)

    def rounded(
        self,
        bits: int,
        output_bits: int | None = None,
        *,
        levels: Levels = Levels.HALF,
        gamma: float = GAMMA,
    ) -> "Weights":
        """Return the weights on the levels of a bit width each; 32 bits leave them as they are."""
        output_bits = output_bits or bits
        rounded = self
        if bits != FLOAT:
            on_levels = self.quantised(bits, bits, levels=levels, gamma=gamma).weights
            rounded = replace(self, W=on_levels.W, U=on_levels.U)
        if output_bits != FLOAT:
            W_y = quantise(self.W_y, output_bits, levels=levels, gamma=gamma).values
            rounded = replace(rounded, W_y=W_y)
        return rounded


@dataclass(frozen=True)
class QuantisedWeights:
    """The same with the nine matrices quantised; biases stay floats, of 16 bits beside 8 or fewer.

    Parameters
    ----------
    W, U
        The gates' matrices in the order i, f, c, o.
    W_y
        The output's.
    """

    W: tuple[Quantised, ...]
    U: tuple[Quantised, ...]
    b: Single
    W_y: Quantised
    b_y: Single

    @property
    def matrices(self) -> tuple[Quantised, ...]:
        """All nine matrices, the output's last."""
        return (*self.W, *self.U, self.W_y)

    @property
    def weights(self) -> Weights:
        """The levels as floats."""
        W = np.concatenate([gate.values for gate in self.W])
        U = np.concatenate([gate.values for gate in self.U])
        return Weights(W, U, self.b, self.W_y.values, self.b_y)


class FloatNetwork:
    """The network in float32.

    Parameters
    ----------
    weights
        Quantised ones run here too, as the levels' values.
    """

    def __init__(self, weights: Weights) -> None:
        n = weights.units
        # With t = tanh(z / 2) a logistic gate is (1 + t) / 2. Its inner half goes into its own row
        # of the matrix, the outer half of o, which makes h, into the columns that h meets.
        i, f, c, o = np.split(np.column_stack([0.5 * weights.U, weights.W, weights.b]), 4)
        A = np.concatenate([0.5 * o, 0.5 * i, 0.5 * f, c])
        self._A = np.asfortranarray(A, dtype=np.float32)  # a third quicker with a vector
        self._W_y, self._b_y = 0.5 * weights.W_y, weights.b_y[:, None]
        self._n = n

    def __call__(self, x: Single) -> Single:
        """Return the outputs ``(B, m)`` for the inputs ``(B, L, d)``."""
        (B, L, d), n = x.shape, self._n
        many = (B,) if B > 1 else ()  # vectors are quicker than matrices of one column
        a = np.zeros((L + 1, n + d + 1, *many), dtype=np.float32)  # (2 h, x, 1) of each step
        a[:L, n:-1] = x.transpose(1, 2, 0).reshape(L, d, *many)
        a[:, -1] = 1.0
        z = np.zeros((5 * n, *many), dtype=np.float32)  # o, i, f, the cell's gate, and c
        product = np.empty((2 * n, *many), dtype=np.float32)
        pushed, kept = product[:n], product[n:]
        one, half = np.ones_like(z[: 3 * n]), np.full_like(z[:n], 0.5)
        gates, logistic, o, c = z[: 4 * n], z[: 3 * n], z[:n], z[4 * n :]
        left, right = z[n : 3 * n], z[3 * n :]  # (i, f) and (gate, c)
        for now, h in zip(a, a[1:, :n], strict=False):
            np.dot(self._A, now, gates)
            np.tanh(gates, gates)
            np.add(logistic, one, logistic)
            np.multiply(left, right, product)
            np.add(pushed, kept, c)
            np.multiply(c, half, c)
            np.tanh(c, h)
            np.multiply(h, o, h)
        y: Single = (self._W_y @ a[L, :n].reshape(n, B) + self._b_y).T
        return y
