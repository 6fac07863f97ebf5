"""Pricing: the flights of least reduced cost, by labels from both ends of a flight."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.both_sides import BothSides
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.completions import completion_bounds
from windopt.solving.exact.joins import ALONE, alone, join
from windopt.solving.exact.labels import LABEL_BYTES, Labels, Memory, Prices, path
from windopt.solving.exact.master import Duals, Master
from windopt.solving.exact.network import Floats, Network
from windopt.solving.exact.ng_neighbourhoods import Neighbourhoods
from windopt.solving.exact.subset_row_cuts import Column, Cuts

TOLERANCE = 1e-6
"""Reduced costs above minus this are not negative: the master's duals are no better."""
MOST_LABELS = 100_000_000
"""Labels of one side of one station, where memory is the only limit."""
FEW, MANY = 40, 400
"""Flights to return of each station, and of all together, at least, where cuts have prices."""


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
        Whether there was room for all labels, so that ``least`` is proved.
    """

    columns: list[Column]
    least: Floats
    complete: bool


class LabelsOverflow(Exception):  # noqa: N818
    """More labels than there is room for."""


@dataclass(frozen=True)
class Pricer:
    """Prices flights over the networks of all stations.

    Parameters
    ----------
    neighbourhoods, cores
        What labels remember, and a part of it, enough to bound what completes them.
    memory
        What the labels of all stations may take [bytes].
    most
        Labels of one side of one station to make at most, if memory allows as many.
    """

    networks: list[Network]
    neighbourhoods: Neighbourhoods
    cores: Neighbourhoods
    clock: Clock
    memory: float
    most: int = MOST_LABELS

    def capacity(self, prices: Prices) -> int:
        """Return how many labels of one side of one station fit into memory.

        Those of all sides are held, and some sides are at work: each makes room for candidates
        and for a copy.
        """
        held = LABEL_BYTES + 8 * prices.inside.shape[1]
        sides = 2 * len(self.networks)
        fitting = int(self.memory / (held * (sides + 2 * min(sides, self.clock.threads))))
        return min(fitting, self.most)

    def sides(self, prices: Prices, grant: Floats) -> BothSides:
        """Return what labels are made from.

        Parameters
        ----------
        grant
            What is granted for flying each leg, shape ``(n + 1, n + 1)``, the station last.
        """
        memory, capacity = self.neighbourhoods.memory, self.capacity(prices)
        networks = [network.granted(grant) for network in self.networks]
        return BothSides(networks, prices, memory, capacity, self.clock)

    def loose(self, prices: Prices, grant: Floats) -> BothSides:
        """Return what labels are made from that know of no subset row and remember little."""
        bare = Cuts.none(len(prices.pi)).prices(prices.pi, np.zeros(0))
        return replace(self.sides(bare, grant), memory=self.cores.memory)

    def price(
        self, master: Master, duals: Duals, *, exact: bool, keep: int | None = None
    ) -> Priced:
        """Find flights of negative reduced cost.

        Parameters
        ----------
        exact
            Whether labels are compared in all respects; without, by time and cost alone.
        keep
            Labels of each turbine in each layer to keep; by default all. Only where all are kept
            and compared in all respects is no flight missed.
        """
        prices = master.cuts.prices(duals.pi, duals.penalty)
        memory, limits = self.neighbourhoods.memory, duals.toll - TOLERANCE
        sides = self.sides(prices, duals.grant)
        costly = exact and bool(prices.penalty.any())
        bounds = completion_bounds(self.loose(prices, duals.grant), limits) if costly else None
        halves, complete = sides.labels(bounds or sides.unbounded, exact=exact, keep=keep)

        def joined(d: int, limit: float) -> tuple[list[Column], float]:
            forward, backward = halves[2 * d], halves[2 * d + 1]
            network = sides.networks[d]
            return _best(
                master, network, d, forward, backward, memory, prices, limit, self.clock.stop
            )

        stations = range(len(self.networks))
        found = self.clock.map(joined, stations, limits)
        columns = [column for flights, _ in found for column in flights]
        least = np.array([cost for _, cost in found]) - duals.toll
        return Priced(columns, np.minimum(least, 0.0), complete)


def _best(
    master: Master,
    network: Network,
    d: int,
    forward: Labels,
    backward: Labels,
    memory: Memory,
    prices: Prices,
    limit: float,
    stop: NDArray[np.uint8],
) -> tuple[list[Column], float]:
    """Return the cheapest flights of station d below ``limit``, and the least cost."""
    cost, partner = join(
        forward, backward, network.forward, memory, prices, network.t_max, network.half,
        limit, stop,
    )  # fmt: skip
    lone, lone_cost = alone(backward, network.forward, network.t_max, network.half)
    below = lone_cost < limit
    lone, lone_cost = lone[below], lone_cost[below]
    costs = np.concatenate([cost, lone_cost])
    flights: dict[frozenset[int], Column] = {}
    costly = bool(prices.penalty.any())
    most = max(FEW, MANY // len(master.networks)) if costly else FEW
    for row in np.argsort(costs, kind="stable")[: 4 * most]:
        if costs[row] >= limit or len(flights) == most:
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
