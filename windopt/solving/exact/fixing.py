"""Fixing: what duals tell of all flights within a gap, and of the legs that these fly."""

from dataclasses import dataclass

import numpy as np

from windopt.solving.exact.completions import Completions
from windopt.solving.exact.labels import Memory, Prices
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Floats, Network
from windopt.solving.exact.subset_row_cuts import Cuts, Path

MARGIN = 1e-4
"""What a gap is widened by before anything is dropped, for the rounding of duals."""


@dataclass(frozen=True)
class Fixing:
    """What is known of flights whose reduced cost is within a gap.

    Parameters
    ----------
    value
        The bound that the duals prove.
    duals, cuts
        The prices of flights, and the cut of each penalty.
    prices, memory
        The same as bits for labels, and the neighbourhoods of these.
    completions
        Least cost of the rest of a flight, for each station.
    through
        Least cost of a flight over each leg, ``(n, n)`` for each station.
    """

    value: float
    duals: Duals
    cuts: Cuts
    prices: Prices
    memory: Memory
    completions: list[Completions]
    through: list[Floats]

    def limits(self, gap: float) -> Floats:
        """Return the cost that no flight of reduced cost up to ``gap`` exceeds, by station."""
        return self.duals.toll + gap + MARGIN

    def useful(self, networks: list[Network], gap: float) -> list[Network]:
        """Return the networks without the legs of flights whose reduced cost exceeds ``gap``."""
        each = zip(networks, self.through, self.limits(gap), strict=True)
        return [network.restricted(through <= limit) for network, through, limit in each]

    def reduced_cost(self, station: int, path: Path, time: float) -> float:
        """Return the reduced cost of a flight without cycles.

        Cuts are counted in full, and crowded sets once however often they are entered.
        """
        visits = np.isin(self.cuts.triples, path).sum(axis=1)
        penalty = self.duals.penalty[visits >= 2].sum()
        entered = self.duals.reward[self.duals.crowded.sets[:, list(path)].any(axis=1)].sum()
        earned = self.duals.pi[list(path)].sum() + self.duals.toll[station] + entered
        return float(time - earned + penalty)
