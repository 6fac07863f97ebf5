"""The pool: every flight that may be part of a better plan, priced by looking at each.

Sets are kept twice: as bits of one flight, to tell its turbines, and as bits of one turbine over
all flights, so that a row is priced for 64 flights at a time.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.bits import NONE, ONE, position
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.labels import Ints, Words, path
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.rank_one_rows import Rows, reaching
from windopt.solving.exact.subset_row_cuts import Path, packed

PART, PARTS = 1 << 16, 8
"""Flights to turn at once, whole words of them; parts to price side by side."""


class Tree(NamedTuple):
    """Last turbine and parent of each half flight."""

    node: Ints
    parent: Ints


@dataclass(frozen=True)
class Pool:
    """Flights, one per set of turbines.

    Parameters
    ----------
    cost, station
        Time and station of each flight, shape ``(m,)``.
    ahead, behind
        The halves it is joined from, rows of ``trees``, or -1.
    sets
        Its turbines as bits, shape ``(m, words)``.
    trees
        Half flights of each station, forward and backward.
    """

    cost: Floats
    station: Ints
    ahead: Ints
    behind: Ints
    sets: Words
    trees: list[tuple[Tree, Tree]]

    def __len__(self) -> int:
        return len(self.cost)

    def kept(self, rows: NDArray[np.intp] | Bools) -> "Pool":
        """Return the flights ``rows``."""
        return replace(
            self,
            cost=self.cost[rows],
            station=self.station[rows],
            ahead=self.ahead[rows],
            behind=self.behind[rows],
            sets=self.sets[rows],
        )

    def members(self, n: int) -> Bools:
        """Return whether each flight visits each turbine, shape ``(m, n)``."""
        as_bytes = np.ascontiguousarray(self.sets).view(np.uint8)
        return np.unpackbits(as_bytes, axis=1, bitorder="little", count=n).view(bool)

    def path(self, row: int) -> Path:
        """Return the turbines of one flight, in order."""
        forward, backward = self.trees[self.station[row]]
        ahead = path(forward.node, forward.parent, int(self.ahead[row]))
        behind = path(backward.node, backward.parent, int(self.behind[row]))
        return ahead + behind[::-1]

    def holds(self, turbines: Path, cost: float) -> bool:
        """Tell whether a set of turbines is in the pool at no greater cost."""
        wanted = np.zeros((1, 64 * self.sets.shape[1]), bool)
        wanted[0, list(turbines)] = True
        same = (self.sets == packed(wanted)).all(axis=1)
        return bool((self.cost[same] <= cost + 1e-6).any())

    def slices(self, n: int, clock: Clock) -> Words:
        """Return each turbine's flights as bits, shape ``(n, words over flights)``."""

        def turned(first: int) -> Words:
            part = self.kept(np.arange(first, min(first + PART, len(self))))
            return packed(np.ascontiguousarray(part.members(n).T))

        parts = clock.map(turned, range(0, max(1, len(self)), PART))
        return np.ascontiguousarray(np.concatenate(parts, axis=1))


@inlined
def _add(cost: Floats, first: int, bits: np.uint64, amount: float) -> None:
    """Add ``amount`` to the cost of each flight whose bit is set, the lowest that of ``first``."""
    while bits != NONE:
        lowest = bits & (~bits + ONE)
        bits ^= lowest
        cost[first + position(lowest)] += amount


@compiled
def _priced(
    cost: Floats,
    slices: Words,
    pi: Floats,
    sets: Bools,
    reward: Floats,
    rows: Rows,
    penalty: Floats,
    start: int,
    end: int,
) -> None:
    """Take rewards off ``cost`` and add penalties, for the words ``start`` to ``end``."""
    for row in range(len(reward)):
        inside = np.flatnonzero(sets[row])
        for word in range(start, end):
            bits = NONE
            for turbine in inside:
                bits |= slices[turbine, word]
            _add(cost, 64 * word, bits, -reward[row])
    for i in range(len(pi)):
        if pi[i] != 0.0:
            for word in range(start, end):
                _add(cost, 64 * word, slices[i, word], -pi[i])
    for row in range(len(penalty)):
        for level in range(1, rows.right[row] + 1):
            share = penalty[row] / rows.right[row]
            for word in range(start, end):
                _add(cost, 64 * word, reaching(slices, word, rows, row, level), share)


def reduced_costs(pool: Pool, slices: Words, duals: Duals, rows: Rows, clock: Clock) -> Floats:
    """Return the reduced cost of each flight, rows counted in full and crowded sets once.

    Parameters
    ----------
    slices
        Of the pool.
    rows
        The row of each of ``duals.penalty``.
    """
    cost = pool.cost - duals.toll[pool.station]
    active = rows.kept(duals.penalty > 0.0)
    penalty = duals.penalty[duals.penalty > 0.0]
    sets, reward = duals.crowded.sets[duals.reward > 0.0], duals.reward[duals.reward > 0.0]

    def price(start: int, end: int) -> None:
        _priced(cost, slices, duals.pi, sets, reward, active, penalty, start, end)

    parts = np.linspace(0, slices.shape[1], PARTS + 1).astype(np.int64)
    clock.map(price, parts[:-1], parts[1:])
    return cost
