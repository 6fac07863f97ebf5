"""Column generation: the master over the flights at hand, and pricing for those that it lacks."""

from dataclasses import dataclass, field, replace
from math import ceil, inf

import numpy as np

from windopt.solving.exact.arc_fixing import Completions, useful_arcs
from windopt.solving.exact.labels import Memory, Prices
from windopt.solving.exact.master import Duals, Master
from windopt.solving.exact.network import SLACK, Floats, Network
from windopt.solving.exact.ng_neighbourhoods import nearest
from windopt.solving.exact.pricing import TOLERANCE, LabelsOverflow, Pricer, bucket
from windopt.solving.exact.search import Flight, Search, alone
from windopt.solving.exact.subset_row_cuts import Path, separate

NEIGHBOURS, MOST_NEIGHBOURS = 8, 16
"""Size of ng-neighbourhoods to begin with, and to let them grow to."""
MOST_COLUMNS, KEPT_COLUMNS = 6000, 3000
"""Columns at which the dearest are dropped, and how many are kept."""
ROUNDING = 1e-6
"""A number of flights this much above a whole one is that."""
LABELS_SHARE = 0.25
"""Share of the memory that labels may take."""
HELPFUL = 0.02
"""Part of the gap that a round of cuts must close to be followed by another."""
MARGIN = 1e-4
"""What a gap is widened by before anything is dropped, for the rounding of duals."""


@dataclass(frozen=True)
class Fixing:
    """What is known of flights whose reduced cost is within a gap.

    Parameters
    ----------
    value
        The bound that the duals prove.
    prices, toll
        What the duals ask of turbines and cuts, and of a flight from each station.
    memory
        The neighbourhoods.
    completions
        Least cost of the rest of a flight, for each station.
    through
        Least cost of a flight over each leg, ``(n, n)`` for each station.
    """

    value: float
    prices: Prices
    memory: Memory
    toll: Floats
    completions: list[Completions]
    through: list[Floats]

    def limits(self, gap: float) -> Floats:
        """Return the cost that no flight of reduced cost up to ``gap`` exceeds, by station."""
        return self.toll + gap + MARGIN

    def useful(self, networks: list[Network], gap: float) -> list[Network]:
        """Return the networks without the legs of flights whose reduced cost exceeds ``gap``."""
        each = zip(networks, self.through, self.limits(gap), strict=True)
        return [network.restricted(through <= limit) for network, through, limit in each]


@dataclass
class Relaxation:
    """The linear relaxation of a search over all its flights.

    Attributes
    ----------
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    duals, least
        Of the last solution, and the least reduced cost that its rounding leaves.
    """

    search: Search
    memory: float
    counts: Floats
    master: Master = field(init=False)
    pricer: Pricer = field(init=False)
    duals: Duals = field(init=False)
    least: float = field(init=False)

    def __post_init__(self) -> None:
        networks = self.search.networks
        self.master = Master(networks, self.counts, self.search.prize)
        flights = (*alone(networks), *self.search.flights)
        self.master.add(self.master.column(d, path) for d, path in flights)
        neighbourhoods = nearest(self.round_trips, NEIGHBOURS)
        memory = LABELS_SHARE * self.memory
        self.pricer = Pricer(networks, neighbourhoods, self.search.clock, memory)

    @property
    def round_trips(self) -> Floats:
        """Least time there and back between turbines, shape ``(n, n)``."""
        networks = self.search.networks
        trips: Floats = np.minimum.reduce([network.legs + network.legs.T for network in networks])
        return trips

    def begin(self) -> None:
        """Solve the master over all flights, for the first time.

        Raises
        ------
        LabelsOverflow
            If memory does not suffice even where a flight remembers nothing but its last turbine.
        OutOfTime
            If time is up.
        """
        size = NEIGHBOURS
        while True:
            neighbourhoods = nearest(self.round_trips, size)
            self.pricer = replace(self.pricer, neighbourhoods=neighbourhoods)
            try:
                return self.solve()
            except LabelsOverflow:
                if size == 1:
                    raise
                size //= 2

    def solve(self) -> None:
        """Solve the master over all flights.

        Exact pricing is asked about duals half way to the best seen, which swing less [1]; what
        it finds there bounds every plan by the duals' value + flights * least reduced cost.

        * [1] Wentges (1997), *International Transactions in Operational Research* 4, 151-162.

        Raises
        ------
        LabelsOverflow
            If there are more labels than memory allows.
        OutOfTime
            If time is up.
        """
        best, centre, exact = -inf, None, False
        while True:
            self.duals = self.master.solve(self.search.clock)
            if not exact:
                priced = self.pricer.price(self.master, self.duals, exact=False, keep=2)
                exact = not self.master.add(priced.columns)
                continue
            trial = self.duals if centre is None else self.duals.towards(centre, 0.5)
            priced = self.pricer.price(self.master, trial, exact=True)
            if not priced.complete:
                raise LabelsOverflow
            least = float(priced.least.min())
            bound = trial.value(self.counts) + self.search.most_flights * least
            self.search.prove(bound)
            if bound > best:
                best, centre = bound, trial
            added = self.master.add(priced.columns)
            if trial is self.duals and (least >= -TOLERANCE or not added):
                self.least = min(least, -TOLERANCE)
                cuts = len(self.master.cuts)
                self.search.note("%d columns, %d cuts", len(self.master.columns), cuts)
                return
            if added:
                exact = False
            else:
                centre = None
            if len(self.master.columns) > MOST_COLUMNS:
                cheapest = np.argsort(self.master.reduced_costs(), kind="stable")[:KEPT_COLUMNS]
                self.master.rebuild([self.master.columns[r] for r in np.sort(cheapest)])

    def reduced_cost(self, station: int, path: Path) -> float:
        """Return the reduced cost of a flight without cycles, cuts counted in full."""
        time = self.search.networks[station].duration(path)
        visits = np.isin(self.master.cuts.triples, path).sum(axis=1)
        penalty = self.duals.penalty[visits >= 2].sum()
        reward = self.duals.pi[list(path)].sum() + self.duals.toll[station]
        return float(time - reward + penalty)

    @property
    def value(self) -> float:
        """Bound that the duals prove."""
        return self.duals.value(self.counts) + self.least * self.search.most_flights

    @property
    def gap(self) -> float:
        """What the duals leave open."""
        return self.search.ceiling - self.value

    def rounded(self) -> list[Flight]:
        """Return flights that do not meet, those first which the solution flies most of."""
        flights: list[Flight] = []
        visited: set[int] = set()
        left = self.search.counts[:-1, 1].copy()
        for column, _ in sorted(self.master.flown(), key=lambda flown: -flown[1]):
            again = len(set(column.path)) < len(column.path) or visited & set(column.path)
            if not again and left[column.station] > 0:
                flights.append((column.station, column.path))
                visited |= set(column.path)
                left[column.station] -= 1
        return flights

    def grow_neighbourhoods(self) -> bool:
        """Forbid the cycles that the solution flies, and tell whether that raised the bound."""
        paths = [column.path for column, _ in self.master.flown()]
        before = self.pricer.neighbourhoods
        grown = before.grown_along(paths, MOST_NEIGHBOURS)
        if grown.sets == before.sets:
            return False
        self.pricer = replace(self.pricer, neighbourhoods=grown)
        self.master.rebuild([column for column in self.master.columns if grown.admit(column.path)])
        try:
            self.solve()
        except LabelsOverflow:
            self.pricer = replace(self.pricer, neighbourhoods=before)
            self.solve()
            return False
        return True

    def round_flights(self) -> bool:
        """Send as many flights as the bound takes, and tell whether that raised it.

        Flights of at most t_max that together take the bound are at least bound / t_max, and
        that many are a whole number. Where turbines may be left out, the bound is not all time.
        """
        longest = max(network.t_max for network in self.search.networks) + SLACK
        least = ceil(self.search.bound / longest - ROUNDING)
        if self.search.partial or not self.counts[-1, 0] < least <= self.counts[:-1, 1].sum():
            return False
        self.counts = self.counts.copy()
        self.counts[-1, 0] = least
        self.master.recount(self.counts)
        self.solve()
        return True

    def cut(self) -> bool:
        """Cut off the fractional solution, and tell whether to go on with that.

        Cuts that make more labels than memory allows are taken back.
        """
        if self.search.closed:
            return False
        self.duals = self.master.solve(self.search.clock)
        gap, before = self.gap, self.master.cuts
        cuts = separate(before.kept(self.duals.penalty > TOLERANCE), self.master.flown())
        if cuts is None:
            return False
        self.master.rebuild(self.master.columns, cuts)
        try:
            self.solve()
        except LabelsOverflow:
            self.master.rebuild(self.master.columns, before)
            self.solve()
            return False
        return gap - self.gap >= HELPFUL * gap

    def fix_arcs(self, ceiling: float | None = None) -> Fixing | None:
        """Drop the legs that no better plan flies.

        Parameters
        ----------
        ceiling
            What better plans keep below; by default that of the search.

        Returns
        -------
        What remains known of the flights within the gap; None where memory does not suffice.
        """
        clock, networks = self.search.clock, self.pricer.networks
        prices = self.master.cuts.prices(self.duals.pi, self.duals.penalty)
        value = self.value
        gap = self.gap if ceiling is None else ceiling - value
        memory = self.pricer.neighbourhoods.memory

        def fix(network: Network, limit: float) -> tuple[Completions, Floats] | None:
            capacity = self.pricer.capacity(prices)
            return useful_arcs(network, prices, memory, bucket(network), limit, capacity, clock)

        found = clock.map(fix, networks, self.duals.toll + gap + MARGIN)
        if any(each is None for each in found):
            return None
        completions, through = zip(*found, strict=True)
        fixing = Fixing(value, prices, memory, self.duals.toll, list(completions), list(through))
        networks = fixing.useful(networks, gap)
        self.pricer = replace(self.pricer, networks=networks)
        self.master.restrict(networks)
        self.search.note("%d legs of use", sum(int(each.arcs.sum()) for each in networks))
        return fixing
