"""Rank-one rows over a pool: the rows "visit i once", weighted, added up and rounded down.

With weights w over a divisor D, the flights of any plan keep

    sum over flights r of floor(sum over i of w_i a_ir / D) x_r <= floor(sum over i of w_i / D).

Subset rows are those of three turbines with weights 1/2. For four and five turbines a few
weights do what all others can [1]. Rows are scaled to a right side of one: the coefficient of
a flight is the rounded sum over the rounded sum of all weights.

* [1] Pecin, Pessoa, Poggi, Uchoa & Santos (2017), *Operations Research Letters* 45, 206-209.
"""

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Words
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.subset_row_cuts import Triples

LARGEST = 5
"""Turbines in a row at most."""
FAMILIES = (
    ((2, 1, 1, 1, 0), 3),
    ((1, 1, 1, 1, 1), 2),
    ((1, 1, 1, 1, 1), 3),
    ((2, 2, 1, 1, 1), 3),
    ((2, 2, 1, 1, 1), 4),
    ((3, 1, 1, 1, 1), 4),
    ((3, 2, 2, 1, 1), 5),
    ((3, 3, 2, 2, 1), 4),
)
"""Weights and divisor of the rows of four and five turbines [1]."""
CANDIDATES = 25
"""Turbines most often visited together with one that may stand beside it in a row."""
BITS = 5
"""Bits of a counter that holds sixteen more than any sum of weights."""
HIGHEST = 1 << (BITS - 1)
"""The value of its highest bit, more than any row asks for."""

Ints64 = NDArray[np.int64]


class Rows(NamedTuple):
    """Rank-one rows.

    Attributes
    ----------
    turbines, weight
        Shape ``(m, 5)``; a turbine of weight zero is not in the row.
    divisor, right
        The divisor and the rounded sum of all weights, shape ``(m,)``.
    """

    turbines: Ints64
    weight: Ints64
    divisor: Ints64
    right: Ints64

    @classmethod
    def of(cls, turbines: Ints64, weight: tuple[int, ...], divisor: int) -> Self:
        """Make rows of the same weights, shape ``(m, len(weight))``."""
        m, size = turbines.shape
        padded = np.zeros((m, LARGEST), np.int64)
        padded[:, :size] = turbines
        weights = np.zeros((m, LARGEST), np.int64)
        weights[:, :size] = weight[:size]
        right = sum(weight) // divisor
        return cls(padded, weights, np.full(m, divisor), np.full(m, right))

    @classmethod
    def subsets(cls, triples: Triples) -> Self:
        """Make the subset rows of ``triples``."""
        return cls.of(triples, (1, 1, 1), 2)

    @property
    def m(self) -> int:
        """Number of rows."""
        return len(self.divisor)

    def kept(self, keep: Bools | NDArray[np.intp]) -> "Rows":
        """Return the rows ``keep``."""
        return Rows(*(each[keep] for each in self))

    def joined(self, other: "Rows") -> "Rows":
        """Return these rows and others."""
        return Rows(*(np.concatenate(pair) for pair in zip(self, other, strict=True)))

    def coefficients(self, members: Bools) -> Floats:
        """Return the coefficient of each flight in each row, shape ``(flights, m)``.

        Parameters
        ----------
        members
            Whether each flight visits each turbine, shape ``(flights, n)``.
        """
        total = np.zeros((len(members), self.m), np.int64)
        for q in range(LARGEST):
            total += members[:, self.turbines[:, q]] * self.weight[:, q]
        return total // self.divisor / self.right


@compiled
def reaching(slices: Words, word: int, rows: Rows, row: int, level: int) -> np.uint64:
    """Return which of 64 flights reach ``level`` times the divisor in one row, as bits.

    Parameters
    ----------
    slices
        Each turbine's flights as bits, shape ``(n, words)``.
    """
    counter = np.zeros(BITS, np.uint64)  # counts so that the highest bit tells
    start = HIGHEST - level * rows.divisor[row]
    for b in range(BITS):
        if start >> b & 1:
            counter[b] = ~NONE
    for q in range(LARGEST):
        for power in range(2):
            if rows.weight[row, q] >> power & 1:
                carry = slices[rows.turbines[row, q], word]
                for b in range(power, BITS):
                    counter[b], carry = counter[b] ^ carry, counter[b] & carry
    return counter[BITS - 1]  # type: ignore[no-any-return]


@compiled
def _rounded(total: Ints64, x: Floats, weight: int, visits: Ints64, divisor: int) -> float:
    """Return the left side of a row that holds ``total`` and one turbine more."""
    left = 0.0
    for r in range(len(x)):
        left += x[r] * ((total[r] + weight * visits[r]) // divisor)
    return left


@compiled
def _climbed(
    row: Ints64, weight: Ints64, divisor: int, visits: Ints64, x: Floats, near: Ints64
) -> float:
    """Exchange turbines of ``row`` while that raises its left side, and return that."""
    total = np.zeros(len(x), np.int64)
    for q in range(len(row)):
        total += weight[q] * visits[row[q]]
    best, better = _rounded(total, x, 0, visits[0], divisor), True
    while better:
        better = False
        for q in range(len(row)):
            old = row[q]
            if weight[q] == 0:
                continue
            rest = total - weight[q] * visits[old]
            for j in near:
                if (row == j).any():
                    continue
                left = _rounded(rest, x, weight[q], visits[j], divisor)
                if left > best + 1e-6:
                    best, row[q], better = left, j, True
            total = rest + weight[q] * visits[row[q]]
    return best


@compiled
def _search(
    weight: Ints64, divisor: int, visits: Ints64, x: Floats, near: Ints64
) -> tuple[Ints64, Floats]:
    """Return a row of large left side about each turbine in each place, and its left side."""
    n = len(visits)
    rows = np.empty((n * LARGEST, LARGEST), np.int64)
    left = np.zeros(n * LARGEST)
    for i in range(n):
        for q in range(LARGEST):
            row = rows[LARGEST * i + q]
            row[:] = near[i, :LARGEST]
            row[0], row[q] = row[q], row[0]
            if q == 0 or weight[q] != weight[q - 1]:
                left[LARGEST * i + q] = _climbed(row, weight, divisor, visits, x, near[i])
    return rows, left


def violated_rows(members: Bools, x: Floats, least: float, clock: Clock) -> tuple[Rows, Floats]:
    """Look for rows of four and five turbines that a fractional plan violates.

    Parameters
    ----------
    members
        Whether each flight visits each turbine, shape ``(flights, n)``.
    x
        How much of each flight is flown.
    least
        Violation from which a row counts, as a part of its right side.

    Returns
    -------
    The rows and their violations; a heuristic, so that there may be more.
    """
    visits = np.ascontiguousarray(members.T.astype(np.int64))
    n = len(visits)
    found, violations = Rows.subsets(np.zeros((0, 3), np.int64)), np.zeros(0)
    if n < LARGEST:
        return found, violations
    together = visits @ (x[:, None] * visits.T)
    np.fill_diagonal(together, np.inf)
    strongest = np.argsort(-together, axis=1, kind="stable")
    near = np.ascontiguousarray(strongest[:, :CANDIDATES])

    def look(family: tuple[tuple[int, ...], int]) -> tuple[Rows, Floats]:
        weight, divisor = family
        each = np.array(weight)
        turbines, left = _search(each, divisor, visits, x, near)
        violation = left / (sum(weight) // divisor) - 1.0
        keep = violation > least
        turbines, violation = _ordered(turbines[keep], each), violation[keep]
        turbines, once = np.unique(turbines, axis=0, return_index=True)
        return Rows.of(turbines, weight, divisor), violation[once]

    for rows, violation in clock.map(look, FAMILIES):
        found, violations = found.joined(rows), np.append(violations, violation)
    return found, violations


def _ordered(turbines: Ints64, weight: Ints64) -> Ints64:
    """Sort the turbines of equal weight in each row, so that equal rows look equal."""
    turbines = np.where(weight > 0, turbines, 0)
    for each in np.unique(weight):
        places = np.flatnonzero(weight == each)
        turbines[:, places] = np.sort(turbines[:, places], axis=1)
    return turbines
