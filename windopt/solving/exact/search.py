"""The state of a search: the best plan, the bound, and the time left."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from logging import getLogger
from math import inf, nan

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import Route, RoutingInstance
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.network import SLACK, Floats, Network, networks

LOGGER = getLogger("windopt.column_generation")

CLOSED = 1e-6
"""Bound and objective this close are equal, in thousandths of t_max / 1000."""

ROUNDED = 1e-9
"""Parts of an objective that rounding may leave open, where it is large: worths in seconds are."""

TOLERATED = 1e-3
"""A bound may exceed a plan by rounding, and by no more than this."""

Flight = tuple[int, tuple[int, ...]]


class ProofError(RuntimeError):
    """A plan contradicts what was proved: an error in this code, not in the input."""


class Search:
    """The best plan and the best bound so far; each only ever improves.

    Parameters
    ----------
    gap
        Relative gap at which to stop.
    progress
        Called with objective and bound [s] whenever one of them improves.
    """

    def __init__(
        self,
        instance: RoutingInstance,
        clock: Clock,
        gap: float = 0.0,
        progress: Callable[[float, float], None] | None = None,
    ) -> None:
        self.instance = instance
        self.networks, self.unit = networks(instance)
        self.n = len(instance.turbines)
        self.prize = _prizes(instance) / self.unit
        self.counts = _counts(instance)
        self.clock = clock
        self.flights: tuple[Flight, ...] = ()
        self.objective = inf
        self.bound = _least_time(self.networks, self.prize)
        self.lp_bound = nan  # of the first relaxation
        self.nodes = 0
        self.crowded = CrowdedSets.none(self.n)  # known to need several flights
        self._gap = gap
        self._progress = progress
        self._merge = all(_obeys_triangle(network) for network in self.networks)

    @contextmanager
    def within(self, limit: float) -> Iterator[None]:
        """Give what is done meanwhile ``limit`` [s]."""
        clock = self.clock
        try:
            with Clock(limit) as self.clock:
                yield
        finally:
            self.clock = clock

    @property
    def found(self) -> bool:
        """Whether there is a plan."""
        return self.objective < inf

    @property
    def partial(self) -> bool:
        """Whether a plan may leave turbines out."""
        return bool(np.isfinite(self.prize).any())

    @property
    def limited(self) -> bool:
        """Whether a station may be short of flights, so that who flies matters beside the time."""
        return bool(np.isfinite(self.counts[:-1, 1]).any())

    @property
    def forfeit(self) -> Floats:
        """What leaving each turbine out costs, no more than a plan of interest may."""
        return np.minimum(self.prize, self.ceiling)

    @property
    def closed(self) -> bool:
        """Whether the bound proves the plan, within the gap asked for."""
        gap = max(self._gap, ROUNDED)
        allowed = max(CLOSED, gap * self.objective) if self.found else 0.0
        return self.objective - self.bound <= allowed

    @property
    def ceiling(self) -> float:
        """A value that every plan of interest keeps below."""
        if self.found:
            return self.objective
        longest = max(network.t_max for network in self.networks)
        return self.n * longest + 1.0

    @property
    def most_flights(self) -> float:
        """Return how many flights a plan no worse than this one needs at most.

        Two flights of one station that fit into one t_max together are one flight at no greater
        cost, so all but one flight of a station take more than half of t_max on average. That
        leaves out no turbine more, and the flights take no longer than time and prizes together.
        """
        most = min(float(self.n), float(self.counts[:-1, 1].sum()))
        if not (self._merge and self.found):
            return most
        shortest = min(network.t_max for network in self.networks)
        return min(most, 2 * self.objective / shortest + len(self.networks))

    @property
    def round_trips(self) -> Floats:
        """Least time there and back between turbines, shape ``(n, n)``."""
        nets = self.networks
        trips: Floats = np.minimum.reduce([net.legs + net.legs.T for net in nets])
        return trips

    @property
    def unreachable(self) -> NDArray[np.intp]:
        """Turbines that must be inspected and that no flight can visit in time."""
        nets = self.networks
        fits = [net.forward.rest + net.backward.rest <= net.t_max + SLACK for net in nets]
        return np.flatnonzero(~np.any(fits, axis=0) & np.isinf(self.prize))

    def offer(self, flights: Sequence[Flight]) -> bool:
        """Take a plan if it is better than the one at hand, and tell whether it was."""
        visits = np.bincount([i for _, path in flights for i in path], minlength=self.n)
        sent = np.bincount([d for d, _ in flights], minlength=len(self.networks))
        times = [self.networks[d].duration(path) for d, path in flights]
        limits = [self.networks[d].t_max + 10 * SLACK for d, _ in flights]
        if (visits > 1).any() or (np.array(times) > np.array(limits)).any():
            return False
        objective = sum(times) + float(self.prize[visits == 0].sum())
        if (sent > self.counts[:-1, 1]).any() or not objective < self.objective - 1e-9:
            return False
        if objective < self.bound - TOLERATED:
            raise ProofError(f"A plan of {objective} lies below the bound {self.bound}.")
        self.flights, self.objective = tuple(flights), objective
        self.bound = min(self.bound, objective)
        self._tell()
        return True

    def prove(self, bound: float) -> None:
        """Take a lower bound on every plan, or on those better than the one at hand."""
        if bound > self.objective + TOLERATED:
            raise ProofError(f"A bound of {bound} exceeds the plan of {self.objective}.")
        bound = min(bound, self.objective)
        if bound > self.bound:
            self.bound = bound
            self._tell()

    def take_as_good(self, flights: Sequence[Flight]) -> None:
        """Take a plan that is better than the one at hand, or as good and preferred."""
        if not self.offer(flights):
            self.flights = tuple(flights)

    def routes(self) -> tuple[Route, ...]:
        """Return the best plan."""
        return tuple(Route(d, path) for d, path in sorted(self.flights))

    def note(self, what: str, *values: object) -> None:
        """Write a line to the log: time, what was done, plan and bound."""
        state = (self.clock.elapsed, self.objective * self.unit, self.bound * self.unit)
        LOGGER.debug("%7.2f s  plan %.2f  bound %.2f  " + what, *state, *values)

    def _tell(self) -> None:
        if self._progress and self.found:
            self._progress(self.objective * self.unit, self.bound * self.unit)


def _prizes(instance: RoutingInstance) -> Floats:
    """Return the prize of each turbine [s], infinite where it must be inspected."""
    return np.full(len(instance.turbines), inf) if instance.prize is None else instance.prize


def _counts(instance: RoutingInstance) -> Floats:
    """Return the least and most flights of each station, and of all, shape ``(k + 1, 2)``."""
    counts = np.tile([0.0, inf], (len(instance.t) + 1, 1))
    if instance.max_flights is not None:
        counts[:-1, 1] = instance.max_flights
    return counts


def arrivals(networks: list[Network], prize: Floats) -> Floats:
    """Return the shortest leg to each turbine, or its prize if that is less; shape ``(n,)``."""
    arrive = np.min([np.minimum(net.out, net.legs.min(axis=0, initial=inf)) for net in networks], 0)
    least: Floats = np.minimum(arrive, prize)
    return least


def _least_time(networks: list[Network], prize: Floats) -> float:
    """Bound any plan by the arrival at each turbine and the shortest leg home."""
    home = min(float(net.back.min(initial=inf)) for net in networks)
    arrive = float(arrivals(networks, prize).sum())
    return arrive + (home if np.isinf(prize).any() else 0.0)


def _obeys_triangle(network: Network) -> bool:
    """Tell whether flying by way of the station never saves time."""
    direct, by_station = network.legs, network.back[:, None] + network.out[None, :]
    off = ~np.eye(len(direct), dtype=bool)
    return bool((direct[off] <= by_station[off] + 1e-9).all())


def alone(networks: list[Network]) -> list[Flight]:
    """Return the fastest flight to each turbine alone, where one fits into t_max."""
    trips: Floats = np.array([net.out + net.back for net in networks])
    trips[trips > np.array([net.t_max for net in networks])[:, None] + SLACK] = inf
    fits = np.isfinite(trips).any(axis=0)
    return [(int(trips[:, i].argmin()), (int(i),)) for i in np.flatnonzero(fits)]
