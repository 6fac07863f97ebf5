"""Crowded sets: turbines that need several flights, and so must be flown into as often.

These rows are the k-path cuts of vehicle routing [1]. In the master a flight counts as often as it
enters a set, so that its price is one of legs, and labels need not remember anything for it. Over a
list of flights it counts once, which is stronger.

* [1] Kohl, Desrosiers, Madsen, Solomon & Soumis (1999), *Transportation Science* 33, 101-116.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from windopt.solving.exact.network import Bools, Floats


@dataclass(frozen=True)
class CrowdedSets:
    """Sets of turbines, and how many flights each needs.

    Parameters
    ----------
    sets
        Shape ``(m, n)``.
    need
        Shape ``(m,)``.
    """

    sets: Bools
    need: Floats

    def __len__(self) -> int:
        return len(self.need)

    @classmethod
    def none(cls, n: int) -> "CrowdedSets":
        """No sets yet, of n turbines."""
        return cls(np.zeros((0, n), bool), np.zeros(0))

    def kept(self, keep: Bools) -> "CrowdedSets":
        """Return the sets where ``keep`` holds."""
        return CrowdedSets(self.sets[keep], self.need[keep])

    def joined(self, other: "CrowdedSets") -> "CrowdedSets":
        """Return these sets and others."""
        return CrowdedSets(
            np.vstack([self.sets, other.sets]), np.concatenate([self.need, other.need])
        )

    @property
    def left_out(self) -> csr_array:
        """What leaving each turbine out counts for, so that rows allow it; shape ``(m, n)``."""
        return csr_array(self.sets * self.need[:, None])

    def entries(self, paths: Sequence[Sequence[int]]) -> Floats:
        """Return how often each path enters each set, shape ``(m, paths)``."""
        if not len(self) or not paths:
            return np.zeros((len(self), len(paths)))
        inside = self.sets[:, np.concatenate(paths)]
        first = np.cumsum([0, *(len(path) for path in paths[:-1])])
        entering = inside.copy()
        entering[:, 1:] &= ~inside[:, :-1]
        entering[:, first] = inside[:, first]
        return np.add.reduceat(entering.astype(float), first, axis=1)

    def visited(self, members: Bools) -> Floats:
        """Return 1 for each set that a flight visits, shape ``(m, flights)``.

        Parameters
        ----------
        members
            Whether each flight visits each turbine, shape ``(flights, n)``.
        """
        common = self.sets.astype(np.float32) @ members.T.astype(np.float32)
        return (common > 0.5).astype(float)

    def grants(self, reward: Floats) -> Floats:
        """Return the rewards of the sets that each leg enters, shape ``(n + 1, n + 1)``.

        Parameters
        ----------
        reward
            Of each set, shape ``(m,)``; the station, which comes last, is in none.
        """
        priced = reward > 0.0
        inside = np.pad(self.sets[priced].astype(float), ((0, 0), (0, 1)))
        total: Floats = (1.0 - inside).T @ (reward[priced, None] * inside)
        return total
