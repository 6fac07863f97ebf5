r"""Quantisation: weights on a few equally spaced levels, stored as small codes.

With :math:`q = 2^k - 1` and :math:`s = \gamma \operatorname{median} |W|`, k bits are given by

.. math::

    Q_k(W) = s \Bigl( \tfrac{1}{q} \bigl\lfloor q \, (\operatorname{clip}(W / s, -\tfrac12,
             \tfrac12) + \tfrac12) + \tfrac12 \bigr\rfloor - \tfrac12 \Bigr)          \tag{1}

The shift back by one half and the scale s are missing in the paper, whose levels therefore lie in
[0, 1] and can express no negative weight. As q is odd, (1) has no level at zero, whatever k: the
matrix stays dense. A second set of levels has one (it is ternary at 2 bits), with
:math:`n = 2^{k-1} - 1`:

.. math::

    Q^0_k(W) = \tfrac{s}{2 n} \operatorname{round}(2 n \operatorname{clip}(W / s, -\tfrac12,
               \tfrac12))                                                           \tag{2}

Either way a weight is an integer times a unit, which is what integer arithmetic needs: in units of
s / (2 q) the levels of (1) are the odd integers from -q to q, and in units of s / (2 n) those of
(2) all integers from -n to n. Idea and gamma: He et al. (2016), arXiv:1611.10176.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput

GAMMA = 2.5
BITS = (2, 4, 8, 16, 32)
FLOAT = 32  # bits of a weight that is not quantised

Codes = NDArray[np.uint16]


class Levels(StrEnum):
    """Which levels a quantised weight may take: (1) or (2)."""

    HALF = "half"  # symmetric around zero, which lies half-way between two levels
    ZERO = "zero"  # symmetric around zero, which is a level


def largest_code(bits: int, levels: Levels) -> int:
    """Return the largest code: q for (1), 2 n for (2)."""
    if bits not in BITS or bits == FLOAT:
        raise InvalidInput("bits", f"among {BITS[:-1]}", bits)
    return (1 << bits) - (1 if levels is Levels.HALF else 2)


def scale(W: NDArray[np.floating], gamma: float = GAMMA) -> float:
    """Return s, the width of the interval that the levels span.

    A matrix of which most entries are zero has no median to speak of; its largest entry stands in.
    """
    median = float(np.median(np.abs(W)))
    s = gamma * median or 2 * float(np.max(np.abs(W))) or 1.0
    return float(np.float32(s))  # as files keep it


@dataclass(frozen=True)
class Quantised:
    """A matrix of integers times a unit.

    Parameters
    ----------
    codes
        Unsigned codes C, from 0 to the largest.
    s
        Width of the interval that the levels span.
    bits
        Bits of one code, k.
    levels
        Which levels the codes count.
    """

    codes: Codes
    s: float
    bits: int
    levels: Levels = Levels.HALF

    @property
    def integers(self) -> NDArray[np.int32]:
        """The weights, signed, counted in :attr:`unit`."""
        C, largest = self.codes.astype(np.int32), largest_code(self.bits, self.levels)
        return 2 * C - largest if self.levels is Levels.HALF else C - largest // 2

    @property
    def unit(self) -> float:
        """What the integers count: s / (2 q) for (1), s / (2 n) for (2)."""
        largest = largest_code(self.bits, self.levels)
        return self.s / (2 * largest if self.levels is Levels.HALF else largest)

    @property
    def values(self) -> NDArray[np.float32]:
        """The weights themselves, float32."""
        return (self.unit * self.integers).astype(np.float32)


def quantise(
    W: NDArray[np.floating], bits: int, *, levels: Levels = Levels.HALF, gamma: float = GAMMA
) -> Quantised:
    """Round ``W`` to the nearest of the levels of ``bits`` bits.

    Parameters
    ----------
    gamma
        Width of the levels' interval in medians of abs(W) [-].
    """
    largest, s = largest_code(bits, levels), scale(W, gamma)
    code = np.floor(largest * (np.clip(W / s, -0.5, 0.5) + 0.5) + 0.5)
    return Quantised(code.astype(np.uint16), s, bits, levels)


def pack(codes: Codes, bits: int) -> NDArray[np.uint8]:
    """Pack codes of ``bits`` bits each into bytes, the first code lowest."""
    if bits > 8:
        return codes.astype("<u2").ravel().view(np.uint8)
    each = 8 // bits
    padded = np.zeros(-(-codes.size // each) * each, dtype=np.uint8)
    padded[: codes.size] = codes.ravel()
    shifts = bits * np.arange(each, dtype=np.uint8)
    packed: NDArray[np.uint8] = np.bitwise_or.reduce(padded.reshape(-1, each) << shifts, axis=1)
    return packed


def unpack(packed: NDArray[np.uint8], bits: int, size: int) -> Codes:
    """Return the first ``size`` codes that :func:`pack` packed.

    Raises
    ------
    InvalidInput
        If there are more or fewer bytes than ``size`` codes take.
    """
    expected = 2 * size if bits > 8 else -(-size // (8 // bits))
    if len(packed) != expected:
        raise InvalidInput("packed weights", f"of {expected} bytes", len(packed))
    if bits > 8:
        return np.ascontiguousarray(packed).view("<u2").astype(np.uint16)
    shifts = bits * np.arange(8 // bits, dtype=np.uint8)
    codes: Codes = ((packed[:, None] >> shifts) & (2**bits - 1)).astype(np.uint16)
    return codes.ravel()[:size]
