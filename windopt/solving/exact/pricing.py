"""Pricing: the flights of least reduced cost, by labels from both ends of a flight."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.joins import ALONE, alone, join
from windopt.solving.exact.labelling import labels
from windopt.solving.exact.labels import (
    LABEL_BYTES,
    UNBOUNDED,
    Labels,
    Memory,
    Prices,
    path,
)
from windopt.solving.exact.master import Duals, Master
from windopt.solving.exact.network import Floats, Network, Side
from windopt.solving.exact.ng_neighbourhoods import Neighbourhoods
from windopt.solving.exact.subset_row_cuts import Column
from windopt.solving.exact.waiting_labels import Span

TOLERANCE = 1e-6
"""Reduced costs above minus this are not negative: the master's duals are no better."""
PER_STATION = 40
"""Flights to return for each station."""


@dataclass(frozen=True)
class Priced:
    """What one round of pricing found.

    Parameters
    ----------
    columns
        Flights of negative reduced cost.
    least
        Least reduced cost of a flight of each station, at most 0; shape ``(k,)``.
    complete
        Whether all labels fitted into memory, so that ``least`` is proved.
    """

    columns: list[Column]
    least: Floats
    complete: bool


class LabelsOverflow(Exception):  # noqa: N818
    """More labels than memory allows."""


@dataclass(frozen=True)
class Pricer:
    """Prices flights over the networks of all stations.

    Parameters
    ----------
    memory
        What the labels of all stations may take [bytes].
    """

    networks: list[Network]
    neighbourhoods: Neighbourhoods
    clock: Clock
    memory: float

    def capacity(self, prices: Prices) -> int:
        """Return how many labels of one side of one station fit into memory.

        Those of all sides are held, and some sides are at work: each makes room for candidates
        and for a copy.
        """
        held = LABEL_BYTES + 8 * prices.memory.shape[1]
        sides = 2 * len(self.networks)
        return int(self.memory / (held * (sides + 2 * min(sides, self.clock.threads))))

    def price(
        self, master: Master, duals: Duals, *, exact: bool, keep: int | None = None
    ) -> Priced:
        """Find flights of negative reduced cost.

        Parameters
        ----------
        exact
            Whether to miss none; without, labels are compared by time and cost alone.
        """
        prices = master.cuts.prices(duals.pi, duals.penalty)
        memory = self.neighbourhoods.memory
        capacity = self.capacity(prices)
        sides = [side for network in self.networks for side in (network.forward, network.backward)]

        def half(side: Side, network: Network) -> tuple[Labels, bool]:
            return labels(
                side, prices, memory, Span(network.t_max, network.half, bucket(network)), exact,
                keep or capacity, UNBOUNDED, capacity, self.clock.stop,
            )  # fmt: skip

        twice = [network for network in self.networks for _ in range(2)]
        halves = self.clock.map(half, sides, twice)
        complete = all(whole for _, whole in halves)

        def joined(d: int, limit: float) -> tuple[list[Column], float]:
            forward, backward = halves[2 * d][0], halves[2 * d + 1][0]
            return _best(master, d, forward, backward, memory, prices, limit, self.clock.stop)

        stations = range(len(self.networks))
        found = self.clock.map(joined, stations, duals.toll - TOLERANCE)
        columns = [column for flights, _ in found for column in flights]
        least = np.array([cost for _, cost in found]) - duals.toll
        return Priced(columns, np.minimum(least, 0.0), complete)


def bucket(network: Network) -> float:
    """Return the width of a time bucket: below the shortest leg, unless that is very short."""
    legs = network.legs[network.arcs]
    shortest = float(legs.min()) if legs.size else network.t_max
    return max(0.999 * shortest, network.t_max / 300)


def _best(
    master: Master,
    d: int,
    forward: Labels,
    backward: Labels,
    memory: Memory,
    prices: Prices,
    limit: float,
    stop: NDArray[np.uint8],
) -> tuple[list[Column], float]:
    """Return the cheapest flights of station d below ``limit``, and the least cost."""
    network = master.networks[d]
    cost, partner = join(
        forward, backward, network.forward, memory, prices.penalty, network.t_max, network.half,
        limit, stop,
    )  # fmt: skip
    lone, lone_cost = alone(backward, network.forward, network.t_max, network.half)
    below = lone_cost < limit
    lone, lone_cost = lone[below], lone_cost[below]
    costs = np.concatenate([cost, lone_cost])
    flights: dict[frozenset[int], Column] = {}
    for row in np.argsort(costs, kind="stable")[: 4 * PER_STATION]:
        if costs[row] >= limit or len(flights) == PER_STATION:
            break
        if row < len(cost):
            flown = path(forward.node, forward.parent, int(row))
            rest = int(partner[row])
        else:
            flown, rest = (), int(lone[row - len(cost)])
        if rest != ALONE:
            flown += path(backward.node, backward.parent, rest)[::-1]
        flights.setdefault(frozenset(flown), master.column(d, flown))
    least = float(costs.min(initial=np.inf))
    return list(flights.values()), least
