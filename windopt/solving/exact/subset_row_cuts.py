"""Subset-row cuts: of any three turbines, at most one flight may visit two or more.

A cut remembers its visits only on some legs, its memory, and forgets them on others [2]; the weaker
coefficient keeps labels comparable. Listed flights, which visit no turbine twice, are priced in
full.

* [1] Jepsen, Petersen, Spoorendonk & Pisinger (2008), *Operations Research* 56, 497-511.
* [2] Pecin, Pessoa, Poggi & Uchoa (2017), *Mathematical Programming Computation* 9, 61-100.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Prices, Words
from windopt.solving.exact.network import Bools, Floats

CUTS, CUTS_EACH = 400, 25
"""Cuts to add at once, and how many of them may share a turbine."""
CANDIDATES = 1000
"""Most violated cuts to choose them from."""
LEAST_VIOLATIONS = (0.02, 0.005)
"""Violations that are looked for, one after the other."""
MOST_VIOLATED = 200_000
"""Violated rows to consider."""

Triples = NDArray[np.int64]
Path = tuple[int, ...]


class Column(NamedTuple):
    """A flight in the master; it may visit a turbine twice."""

    station: int
    path: Path
    cost: float


@dataclass(frozen=True)
class Cuts:
    """Subset-row cuts of limited memory.

    Parameters
    ----------
    triples
        Their turbines, shape ``(m, 3)``, increasing in each row.
    memory
        The legs on which they remember, shape ``(m, n, n)``.
    """

    triples: Triples
    memory: Bools

    def __len__(self) -> int:
        return len(self.triples)

    @classmethod
    def none(cls, n: int) -> "Cuts":
        """No cuts yet, for n turbines."""
        return cls(np.zeros((0, 3), np.int64), np.zeros((0, n, n), bool))

    def kept(self, keep: Bools) -> "Cuts":
        """Return the cuts where ``keep`` holds."""
        return Cuts(self.triples[keep], self.memory[keep])

    def joined(self, other: "Cuts") -> "Cuts":
        """Return these cuts and others."""
        return Cuts(
            np.concatenate([self.triples, other.triples]),
            np.concatenate([self.memory, other.memory]),
        )

    @cached_property
    def words(self) -> tuple[Words, Words]:
        """Memory and subsets as bits, a row of words per leg and per turbine."""
        m, n, _ = self.memory.shape
        inside = np.zeros((m, n), bool)
        inside[np.arange(m)[:, None], self.triples] = True
        return packed(self.memory.reshape(m, n * n).T).reshape(n, n, -1), packed(inside.T)

    def prices(self, pi: Floats, penalty: Floats) -> Prices:
        """Return what pricing needs of the duals; cuts without a price are left out."""
        active = penalty > 1e-7
        memory, inside = self.kept(active).words
        padded = np.zeros(64 * inside.shape[1])
        padded[: active.sum()] = penalty[active]
        return Prices(pi, padded, memory, inside)

    def coefficients(self, paths: Sequence[Path]) -> Floats:
        """Return the coefficient of each path in each cut, shape ``(m, paths)``."""
        if not len(self) or not paths:
            return np.zeros((len(self), len(paths)))
        memory, inside = self.words
        return _coefficients(*one_after_the_other(paths), memory, inside, len(self))


def packed(sets: Bools) -> Words:
    """Return each row of ``sets`` as a row of 64-bit words."""
    rows, size = sets.shape
    padded = np.zeros((rows, 64 * (-(-size // 64))), bool)
    padded[:, :size] = sets
    return np.packbits(padded, axis=1, bitorder="little").view(np.uint64)


def one_after_the_other(paths: Sequence[Path]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the turbines of all paths, and where each path ends among them."""
    turbines = np.array([i for path in paths for i in path], np.int64)
    return turbines, np.cumsum([len(path) for path in paths], dtype=np.int64)


@compiled
def _coefficients(
    turbines: NDArray[np.int64], ends: NDArray[np.int64], memory: Words, inside: Words, m: int
) -> Floats:
    coefficient = np.zeros((m, len(ends)))
    words = inside.shape[1]
    start = 0
    for r in range(len(ends)):
        for word in range(words):
            parity = NONE
            for position in range(start, ends[r]):
                i = turbines[position]
                if position > start:
                    parity &= memory[turbines[position - 1], i, word]
                pairs = parity & inside[i, word]
                parity ^= inside[i, word]
                cut = word * 64
                while pairs != NONE:
                    if pairs & ONE != NONE:
                        coefficient[cut, r] += 1.0
                    pairs >>= ONE
                    cut += 1
        start = ends[r]
    return coefficient


@compiled
def violations(
    visits: NDArray[np.int64], x: Floats, least: float, most: int
) -> tuple[Triples, Floats]:
    """Find the subset rows that a fractional plan violates with full memory.

    Parameters
    ----------
    visits
        How often each flight visits each turbine, shape ``(n, flights)``.
    x
        How much of each flight is flown.
    least
        Violation from which a row counts.
    most
        Rows to return at most.

    Returns
    -------
    Triples of turbines, and their violations.
    """
    n, flights = visits.shape
    together = np.zeros((n, n))
    for i in range(n):
        for r in range(flights):
            if visits[i, r] > 0:
                for j in range(i + 1, n):
                    if visits[j, r] > 0:
                        together[i, j] += x[r]
    triples = np.empty((most, 3), np.int64)
    violation = np.empty(most)
    count = 0
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(j + 1, n):
                # Each pair of visits by one flight counts once here, and at most once below.
                if together[i, j] + together[i, k] + together[j, k] <= 1.0 + least:
                    continue
                excess = -1.0
                for r in range(flights):
                    excess += ((visits[i, r] + visits[j, r] + visits[k, r]) >> 1) * x[r]
                if excess > least and count < most:
                    triples[count, 0], triples[count, 1], triples[count, 2] = i, j, k
                    violation[count] = excess
                    count += 1
    return triples[:count], violation[:count]


def separate(cuts: Cuts, flown: Sequence[tuple[Column, float]]) -> Cuts | None:
    """Return cuts that a fractional plan violates, or None where there are none.

    Those come first that are violated much for the legs they must remember. One of ``cuts`` that
    remembers too little is found again, with all that it must remember.

    Parameters
    ----------
    flown
        The flights of the plan, which may visit a turbine twice, and how much of each is flown.
    """
    n = cuts.memory.shape[1]
    paths = [column.path for column, _ in flown]
    visits = np.zeros((n, len(paths)), np.int64)
    for r, path in enumerate(paths):
        np.add.at(visits[:, r], list(path), 1)
    x = np.array([share for _, share in flown])
    flat = one_after_the_other(paths)
    for least in LEAST_VIOLATIONS:
        triples, violation = violations(visits, x, least, MOST_VIOLATED)
        most = np.argsort(-violation, kind="stable")[:CANDIDATES]
        candidates, known = triples[most], _known(cuts, triples[most])
        needed = memory_along(candidates, *flat, n)
        needed |= known
        legs = needed.sum(axis=(1, 2))
        rows = spread(candidates, violation[most] / (triples.shape[1] + legs), n, CUTS, CUTS_EACH)
        rows = rows[(needed[rows] != known[rows]).any(axis=(1, 2))]
        if len(rows):
            return Cuts(candidates[rows], needed[rows])
    return None


def _known(cuts: Cuts, triples: Triples) -> Bools:
    """Return the legs on which the cuts of ``triples`` remember so far, shape ``(m, n, n)``."""
    n = cuts.memory.shape[1]
    memory = dict(zip(map(tuple, cuts.triples.tolist()), cuts.memory, strict=True))
    known = np.zeros((len(triples), n, n), bool)
    for row, triple in enumerate(map(tuple, triples.tolist())):
        if triple in memory:
            known[row] = memory[triple]
    return known


def spread(turbines: Triples, worth: Floats, n: int, most: int, each: int) -> NDArray[np.intp]:
    """Choose the rows of most worth, with every turbine in at most ``each`` of them.

    Parameters
    ----------
    turbines
        Of each row, shape ``(m, size)``; one that is named twice counts once.
    worth
        Shape ``(m,)``.
    """
    used = np.zeros(n, int)
    chosen = []
    for row in np.argsort(-worth, kind="stable"):
        if (used[turbines[row]] < each).all():
            used[turbines[row]] += 1
            chosen.append(row)
            if len(chosen) == most:
                break
    return np.array(chosen, np.intp)


@compiled
def memory_along(
    triples: Triples, turbines: NDArray[np.int64], ends: NDArray[np.int64], n: int
) -> Bools:
    """Return the legs to remember on for the full coefficient of each path in each row.

    Parameters
    ----------
    turbines, ends
        Of :func:`one_after_the_other`.

    Returns
    -------
    Shape ``(m, n, n)``.
    """
    memory = np.zeros((len(triples), n, n), np.bool_)
    for row in range(len(triples)):
        start = 0
        for end in ends:
            first = -1  # visits count in pairs, so nothing is remembered after a last odd one
            for position in range(start, end):
                if (triples[row] == turbines[position]).any():
                    if first >= 0:
                        for leg in range(first, position):
                            memory[row, turbines[leg], turbines[leg + 1]] = True
                        first = -1
                    else:
                        first = position
            start = end
    return memory
