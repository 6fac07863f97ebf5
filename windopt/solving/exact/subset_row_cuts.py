"""Subset-row cuts: of any three turbines, at most one flight may visit two or more.

A cut remembers its visits only in a set of turbines, its memory, and forgets them outside [2];
the weaker coefficient keeps labels comparable. Flights that visit no turbine twice are priced
in full: their memory is everywhere.

* [1] Jepsen, Petersen, Spoorendonk & Pisinger (2008), *Operations Research* 56, 497-511.
* [2] Pecin, Pessoa, Poggi & Uchoa (2017), *Mathematical Programming Computation* 9, 61-100.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Prices, Words
from windopt.solving.exact.network import Bools, Floats

CUTS, CUTS_EACH = 50, 4
"""Cuts to add at once, and how many of them may share a turbine."""
LEAST_VIOLATIONS = (0.05, 0.02, 0.005)
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
        Where they remember, shape ``(m, n)``.
    """

    triples: Triples
    memory: Bools

    def __len__(self) -> int:
        return len(self.triples)

    @classmethod
    def none(cls, n: int) -> "Cuts":
        """No cuts yet, for n turbines."""
        return cls(np.zeros((0, 3), np.int64), np.zeros((0, n), bool))

    def kept(self, keep: Bools) -> "Cuts":
        """Return the cuts where ``keep`` holds."""
        return Cuts(self.triples[keep], self.memory[keep])

    def words(self) -> tuple[Words, Words]:
        """Return memory and subsets as bits, a row of words per turbine."""
        inside = np.zeros_like(self.memory)
        inside[np.arange(len(self))[:, None], self.triples] = True
        return packed(self.memory.T), packed(inside.T)

    def prices(self, pi: Floats, penalty: Floats) -> Prices:
        """Return what pricing needs of the duals; cuts without a price are left out."""
        active = penalty > 1e-7
        memory, inside = self.kept(active).words()
        padded = np.zeros(64 * memory.shape[1])
        padded[: active.sum()] = penalty[active]
        return Prices(pi, padded, memory, inside)

    def coefficients(self, paths: Sequence[Path]) -> Floats:
        """Return the coefficient of each path in each cut, shape ``(m, paths)``."""
        if not len(self) or not paths:
            return np.zeros((len(self), len(paths)))
        memory, inside = self.words()
        turbines = np.array([i for path in paths for i in path], np.int64)
        ends = np.cumsum([len(path) for path in paths], dtype=np.int64)
        return _coefficients(turbines, ends, memory, inside, len(self))


def packed(sets: Bools) -> Words:
    """Return each row of ``sets`` as a row of 64-bit words."""
    rows, size = sets.shape
    padded = np.zeros((rows, 64 * (-(-size // 64))), bool)
    padded[:, :size] = sets
    return np.packbits(padded, axis=1, bitorder="little").view(np.uint64)


@compiled
def _coefficients(
    turbines: NDArray[np.int64], ends: NDArray[np.int64], memory: Words, inside: Words, m: int
) -> Floats:
    coefficient = np.zeros((m, len(ends)))
    words = memory.shape[1]
    start = 0
    for r in range(len(ends)):
        for word in range(words):
            parity = NONE
            for position in range(start, ends[r]):
                i = turbines[position]
                parity &= memory[i, word]
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
    """Return ``cuts`` and those that a fractional plan violates, or None where there are none.

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
    for least in LEAST_VIOLATIONS:
        triples, violation = violations(visits, x, least, MOST_VIOLATED)
        chosen = triples[spread(triples, violation, n, CUTS, CUTS_EACH)]
        memories = {tuple(t): m for t, m in zip(cuts.triples.tolist(), cuts.memory, strict=True)}
        grown = False
        for triple in chosen:
            key = tuple(triple.tolist())
            known = memories.get(key, np.zeros(n, bool))
            memories[key] = known | memory_along(triple, paths, n)
            grown = grown or (memories[key] != known).any()
        if grown:
            return Cuts(np.array(list(memories), np.int64), np.array(list(memories.values())))
    return None


def spread(triples: Triples, violation: Floats, n: int, most: int, each: int) -> NDArray[np.intp]:
    """Choose the most violated rows, with every turbine in at most ``each`` of them."""
    used = np.zeros(n, int)
    chosen = []
    for row in np.argsort(-violation, kind="stable"):
        if (used[triples[row]] < each).all():
            used[triples[row]] += 1
            chosen.append(row)
            if len(chosen) == most:
                break
    return np.array(chosen, np.intp)


def memory_along(triple: NDArray[np.int64], paths: Sequence[Path], n: int) -> Bools:
    """Return the least memory that gives each of ``paths`` its full coefficient, shape ``(n,)``."""
    memory = np.zeros(n, bool)
    memory[triple] = True
    members = set(triple.tolist())
    for path in paths:
        visits = [position for position, i in enumerate(path) if i in members]
        for first, second in zip(visits[::2], visits[1::2], strict=False):
            memory[list(path[first : second + 1])] = True
    return memory
