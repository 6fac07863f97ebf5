"""Both sides: the labels of all stations, forward and backward, made side by side."""

from collections.abc import Sequence
from dataclasses import dataclass

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.labelling import labels
from windopt.solving.exact.labels import UNBOUNDED, Bound, Labels, Memory, Prices, turned
from windopt.solving.exact.network import Network, Side
from windopt.solving.exact.waiting_labels import Span

ALL = 2**31 - 1
"""Labels of each turbine in each layer to keep where none may be lost."""


@dataclass(frozen=True)
class BothSides:
    """What the labels of all stations are made from.

    Parameters
    ----------
    capacity
        Labels of one side of one station to hold at most.
    """

    networks: list[Network]
    prices: Prices
    memory: Memory
    capacity: int
    clock: Clock

    @property
    def unbounded(self) -> list[Bound]:
        """A bound for each side that drops no label."""
        return [UNBOUNDED] * (2 * len(self.networks))

    def labels(
        self,
        bounds: Sequence[Bound],
        *,
        whole: bool = False,
        exact: bool = True,
        keep: int | None = None,
    ) -> tuple[list[Labels], bool]:
        """Return forward and backward labels, station by station, and whether they are complete.

        Parameters
        ----------
        bounds
            Of each side, in the same order.
        whole
            Whether labels go on to t_max, not to half of it.
        exact, keep
            As of :func:`~windopt.solving.exact.labelling.labels`.
        """

        def made(side: Side, prices: Prices, network: Network, bound: Bound) -> tuple[Labels, bool]:
            span = Span(network.t_max, network.t_max if whole else network.half, bucket(network))
            return labels(
                side, prices, self.memory, span, exact, keep or ALL, bound,
                self.capacity, self.clock.stop,
            )  # fmt: skip

        sides = [side for each in self.networks for side in (each.forward, each.backward)]
        prices = [self.prices, turned(self.prices)] * len(self.networks)
        twice = [network for network in self.networks for _ in range(2)]
        found = self.clock.map(made, sides, prices, twice, bounds)
        return [each for each, _ in found], all(complete for _, complete in found)


def bucket(network: Network) -> float:
    """Return the width of a time bucket: below the shortest leg, unless that is very short."""
    legs = network.legs[network.arcs]
    shortest = float(legs.min()) if legs.size else network.t_max
    return max(0.999 * shortest, network.t_max / 300)
