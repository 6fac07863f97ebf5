"""Column generation: the master over the flights at hand, and pricing for those that it lacks."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from math import ceil

import numpy as np

from windopt.solving.exact.arc_fixing import useful_arcs
from windopt.solving.exact.crowding import Crowding
from windopt.solving.exact.fixing import MARGIN, Fixing
from windopt.solving.exact.master import Duals, Master
from windopt.solving.exact.network import SLACK, Floats
from windopt.solving.exact.ng_neighbourhoods import nearest
from windopt.solving.exact.pricing import MOST_LABELS, TOLERANCE, LabelsOverflow, Pricer
from windopt.solving.exact.search import Search, alone
from windopt.solving.exact.subset_row_cuts import separate

NEIGHBOURS, MOST_NEIGHBOURS = 8, 16
"""Size of ng-neighbourhoods to begin with, and to let them grow to."""
CORE = 6
"""Size of the neighbourhoods of labels that only bound what completes others."""
HURRIED = ((False, 2), (True, 40))
"""Ways to price that may miss flights, the quickest first and the second only with cuts: whether
labels are compared in all respects, and how many of each turbine in each layer are kept."""
MOST_COLUMNS, KEPT_COLUMNS = 6000, 3000
"""Columns at which the dearest are dropped, and how many are kept."""
ROUNDING = 1e-6
"""A number of flights this much above a whole one is that."""
CHOICES = 2
"""Times to look for cuts over the flights at hand, before others are priced."""
WORTH = 600_000
"""Labels of one side of one station that cuts are worth, at first; listing flights is quicker from
there."""
LABELS_SHARE = 0.2
"""Share of the memory that labels may take; those that fixed the legs are held as well."""
ENTERED = 0.005
"""Part of the gap that rows of crowded sets must close to be followed by others."""
HELPFUL = 0.02
"""Part of the gap that a round of cuts must close to be followed by another."""


@dataclass
class Relaxation:
    """The linear relaxation of a search over all its flights.

    Attributes
    ----------
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    duals, least
        Of the last solution, and the least reduced cost that its rounding leaves.
    crowding
        What is known of how many flights turbines need.
    overfull
        Whether rows have made more labels than they are worth, so that no more are added.
    worth
        Labels of one side of one station that rows are worth.
    """

    search: Search
    memory: float
    counts: Floats
    master: Master = field(init=False)
    pricer: Pricer = field(init=False)
    duals: Duals = field(init=False)
    least: float = field(init=False)
    crowding: Crowding = field(init=False)
    overfull: bool = False
    worth: int = WORTH

    def __post_init__(self) -> None:
        networks = self.search.networks
        self.master = Master(networks, self.counts, self.search.prize)
        flights = (*alone(networks), *self.search.flights)
        self.master.add(self.master.column(d, path) for d, path in flights)
        trips = self.search.round_trips
        neighbourhoods, cores = (nearest(trips, size) for size in (NEIGHBOURS, CORE))
        memory = LABELS_SHARE * self.memory
        self.crowding = Crowding.of(networks, np.isinf(self.search.prize), self.search.clock)
        self.pricer = Pricer(networks, neighbourhoods, cores, self.search.clock, memory)

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
            neighbourhoods = nearest(self.search.round_trips, size)
            cores = nearest(self.search.round_trips, min(size, CORE))
            self.pricer = replace(self.pricer, neighbourhoods=neighbourhoods, cores=cores)
            try:
                return self.solve()
            except LabelsOverflow:
                if size == 1:
                    raise
                size //= 2

    def solve(self) -> None:
        """Solve the master over all flights.

        Pricing that may miss flights goes before pricing that does not, which bounds every plan
        by the duals' value + flights * least reduced cost.

        Raises
        ------
        LabelsOverflow
            If there are more labels than memory allows.
        OutOfTime
            If time is up.
        """
        ways, hurry = HURRIED if len(self.master.cuts) else HURRIED[:1], 0
        while True:
            self.duals = self.master.solve(self.search.clock)
            if len(self.master.columns) > MOST_COLUMNS:
                self.master.keep_cheapest(KEPT_COLUMNS)
                continue
            if hurry < len(ways):
                exact, keep = ways[hurry]
                priced = self.pricer.price(self.master, self.duals, exact=exact, keep=keep)
                hurry = 0 if self.master.add(priced.columns) else hurry + 1
                continue
            priced = self.pricer.price(self.master, self.duals, exact=True)
            if not priced.complete:
                raise LabelsOverflow
            least = float(priced.least.min())
            self.search.prove(self.duals.value(self.counts) + self.search.most_flights * least)
            if least >= -TOLERANCE or not self.master.add(priced.columns):
                self.least = min(least, -TOLERANCE)
                cuts = len(self.master.cuts)
                self.search.note("%d columns, %d cuts", len(self.master.columns), cuts)
                return
            hurry = 0

    @property
    def value(self) -> float:
        """Bound that the duals prove."""
        return self.duals.value(self.counts) + self.least * self.search.most_flights

    @property
    def gap(self) -> float:
        """What the duals leave open."""
        return self.search.ceiling - self.value

    def grow_neighbourhoods(self) -> bool:
        """Forbid the cycles that the solution flies, and tell whether that raised the bound."""
        paths = [column.path for column, _ in self.master.flown()]
        before = self.pricer.neighbourhoods
        grown = before.grown_along(paths, MOST_NEIGHBOURS)
        if grown.sets == before.sets:
            return False
        self.pricer = replace(self.pricer, neighbourhoods=grown)
        self.master.keep(np.array([grown.admit(column.path) for column in self.master.columns]))
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
        if self.search.closed or self.search.partial or self.overfull:
            return False
        longest = max(network.t_max for network in self.search.networks) + SLACK
        least = ceil(self.search.bound / longest - ROUNDING)
        if not self.counts[-1, 0] < least <= self.counts[:-1, 1].sum():
            return False
        before = self.counts
        self._recount(np.vstack([before[:-1], [least, before[-1, 1]]]))
        return self._solved_or(partial(self._recount, before), self._most)

    @property
    def _most(self) -> int:
        """Labels of one side of one station to make at most: fewer where they know of cuts."""
        return self.worth if len(self.master.cuts) else MOST_LABELS

    def _solved_or(self, undo: Callable[[], None], most: int) -> bool:
        """Solve after a change of the master, or undo it where it makes more labels than ``most``.

        Returns
        -------
        Whether the change stays; if not, what was proved before it is known still.
        """
        pricer, proved = self.pricer, (self.duals, self.least)
        self.pricer = replace(pricer, most=most)
        try:
            self.solve()
        except LabelsOverflow:
            undo()
            self.master.solve(self.search.clock)  # not priced: the duals before are proved
            (self.duals, self.least), self.overfull = proved, True
            return False
        finally:
            self.pricer = pricer
        return True

    def relent(self) -> None:
        """Let rows make more labels than they were worth: lists of flights are too long as well."""
        if self.overfull:
            self.overfull, self.worth = False, 2 * self.worth

    def _recount(self, counts: Floats) -> None:
        self.counts = counts
        self.master.recount(counts)

    def enter_crowded_sets(self) -> bool:
        """Send as many flights into turbines as these need, and tell whether to go on with that."""
        if self.search.closed or self.overfull:
            return False
        master, before, gap = self.master, self.master.crowded, self.gap
        flown = [((column.station, column.path), share) for column, share in master.flown()]
        found = self.crowding.lacking(flown)
        if not len(found):
            return False
        master.keep_crowded(self.duals.reward > TOLERANCE)
        master.enter(found)
        undo = partial(master.rebuild, master.columns, crowded=before)
        if not self._solved_or(undo, self._most):
            return False
        self.search.crowded = master.crowded
        return gap - self.gap >= ENTERED * gap

    def cut(self, most: int) -> bool:
        """Cut off the fractional solution, and tell whether to go on with that.

        Cuts are taken back where they make too many labels.

        Parameters
        ----------
        most
            Labels of one side of one station to make at most, if memory allows as many and cuts
            are worth it.
        """
        if self.search.closed or self.overfull:
            return False
        before, gap = self.master.cuts, self.gap
        if not self._choose_cuts():
            return False
        undo = partial(self.master.rebuild, self.master.columns, before)
        solved = self._solved_or(undo, min(most, self.worth))
        return solved and gap - self.gap >= HELPFUL * gap

    def _choose_cuts(self) -> bool:
        """Put violated cuts into the master, those that matter together to the flights at hand."""
        master, clock = self.master, self.search.clock
        for choice in range(CHOICES):
            found = separate(master.cuts, master.flown())
            if found is None:
                return choice > 0
            master.cut(found)
            duals = master.solve(clock)  # not priced: others are proved
            master.keep_cuts(duals.penalty > TOLERANCE)
        return True

    def fix_arcs(self, ceiling: float | None = None, most: int = MOST_LABELS) -> Fixing | None:
        """Drop the legs that no better plan flies.

        Parameters
        ----------
        ceiling
            What better plans keep below; by default that of the search.
        most
            Labels of one side of one station to make at most, if memory allows as many.

        Returns
        -------
        What remains known of the flights within the gap; None where labels are too many.
        """
        gap = self.gap if ceiling is None else ceiling - self.value
        cuts, duals = self.master.cuts, self.duals
        prices = cuts.prices(duals.pi, duals.penalty)
        sides = replace(self.pricer, most=most).sides(prices, duals.grant)
        loose = self.pricer.loose(prices, duals.grant)
        found = useful_arcs(sides, loose, duals.toll + gap + MARGIN)
        if found is None:
            return None
        fixing = Fixing(self.value, duals, cuts, prices, sides.memory, *found)
        networks = fixing.useful(self.pricer.networks, gap)
        self.pricer = replace(self.pricer, networks=networks)
        self.master.restrict(networks)
        self.search.note("%d legs of use", sum(int(each.arcs.sum()) for each in networks))
        return fixing
