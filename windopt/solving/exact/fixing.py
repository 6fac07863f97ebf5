"""Fixing: what duals tell of all flights within a gap, and of the legs that these fly."""

from dataclasses import dataclass

from windopt.solving.exact.completions import Completions
from windopt.solving.exact.labels import Memory, Prices
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Floats, Network
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.row_duals import RowDuals
from windopt.solving.exact.subset_row_cuts import Cuts

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

    @property
    def in_full(self) -> RowDuals:
        """The duals for flights without cycles, which keep cuts in full."""
        return RowDuals(self.duals, Rows.subsets(self.cuts.triples))
