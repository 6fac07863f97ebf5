"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta; and the rows that tighten the program over these are those that
a larger delta begins with.
"""

from dataclasses import dataclass, replace
from math import inf, log

from windopt.solving.exact.branching import MOST, branch
from windopt.solving.exact.enumeration import enumerate_flights, most_flights, most_made
from windopt.solving.exact.fixing import MARGIN, Fixing
from windopt.solving.exact.local_search import improve
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.pricing import MOST_LABELS
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.screening import RowDuals, Screen, mixed, together_below
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.tightening import tighten

FIRST_PART, LARGER, SMALLER = 0.1, 1.5, 0.5
"""Part of the gap to begin with where the whole is too much, by what it grows, and by what it
shrinks where even the first is too much."""
FILLED = 0.7
"""Part of the room for flights that the longest list is expected to take."""
WORTHWHILE = 1.08
"""A further list is made only where one is expected to fit that goes this many times as far as is
proved, or all the way."""
MIX, SPARE = 0.5, 1.5
"""Part of the last list's prices in those that screen the next, the prices of labels being the
rest; and times what these leave up to the target that a flight may cost at first."""
WIDER = 1.5
"""Times a gap that was too wide to list which is not even tried."""
THOROUGH = 8
"""Times the first local search to search again where many flights are left to choose among."""


@dataclass
class Closing:
    """What is left between the relaxation of a search and its best plan.

    Parameters
    ----------
    seed
        Of the local search.

    Attributes
    ----------
    fixing
        The last that labels were not too many for; it stays true as the relaxation goes on.
    tried
        The duals for which legs were fixed last, or could not be.
    known
        Duals and rows of the last list of flights, with which the next begins.
    part
        Part of the gap to begin with where the whole is too much.
    too_wide
        The reduced cost up to which flights were too many last.
    listed
        Reduced costs up to which flights were listed since parts of the gap were last begun with,
        and how many were made for that.
    """

    relaxation: Relaxation
    seed: int
    fixing: Fixing | None = None
    tried: Duals | None = None
    known: RowDuals | None = None
    part: float = FIRST_PART
    too_wide: float = inf
    listed: tuple[tuple[float, int], ...] = ()

    @property
    def search(self) -> Search:
        """The search to close."""
        return self.relaxation.search

    def close(self, effort: int, *, in_parts: bool) -> bool:
        """Find the best plan and prove it, unless flights are too many.

        Parameters
        ----------
        effort
            Labels and half flights of one side of one station to hold at most; memory may allow
            fewer.
        in_parts
            Whether to close parts of the gap where the whole is too much.

        Returns
        -------
        Whether the gap is closed.
        """
        if self.search.closed:
            return True
        fixed = self.fix(effort)
        if self.fixing is None:
            return False
        gap = self.search.ceiling - self.fixing.value
        hopeless = gap > min(WIDER * self.too_wide, self._affordable(effort))
        if fixed and not hopeless and self._search_within(gap, self.fixing, effort):
            return True
        return in_parts and self._close_parts(self.fixing, effort)

    def fix(self, most: int) -> bool:
        """Fix legs within the gap, and tell whether labels are not too many to tell which.

        Cuts do not go on where they make them too many: only what is fixed can be listed.

        Parameters
        ----------
        most
            Labels of one side of one station that know of cuts to make at most, if memory allows
            as many and cuts are worth it.
        """
        relaxation, duals = self.relaxation, self.relaxation.duals
        fixed = self.fixing is not None and self.fixing.duals is duals
        if duals is not self.tried:
            self.tried = duals
            cuts = len(relaxation.master.cuts)
            fixing = relaxation.fix_arcs(most=min(most, relaxation.worth) if cuts else MOST_LABELS)
            self.fixing, fixed = fixing or self.fixing, fixing is not None
            relaxation.overfull |= not fixed and cuts > 0
        return fixed

    def _close_parts(self, fixing: Fixing, effort: int) -> bool:
        """Close ever larger parts of the gap, and tell whether that came to the whole.

        Where one is too much after others were not, one between the two is the last.
        """
        search, part, failed = self.search, self.part, inf
        self.listed = ()
        while True:
            proved, whole = max(0.0, search.bound - fixing.value), search.ceiling - fixing.value
            affordable = self._affordable(effort)
            if affordable < min(WORTHWHILE * proved, whole):
                return False
            wanted = proved + part * (search.ceiling - search.bound)
            delta = min(wanted, proved + SMALLER * (failed - proved), affordable)
            fits = self._search_within(delta, fixing, effort)
            if search.closed or (fits and delta >= search.ceiling - fixing.value):
                return True
            if not fits and part == self.part:
                self.part *= SMALLER
                return False
            if failed < inf:
                return False
            part = min(1.0, LARGER * part)
            failed = inf if fits else delta

    def _affordable(self, effort: int) -> float:
        """Return the gap whose flights are expected to take much of the room for flights.

        Each unit more makes flights more by the same factor, as the last two lists tell; a little
        less, in fact. No gap that was listed is too much.
        """
        if len(self.listed) < 2:
            return inf
        (less, few), (more, many) = self.listed[-2:]
        if not (more > less and many > few):
            return inf
        growth = log(many / few) / (more - less)
        room = most_flights(self.search.n, effort, self.relaxation.memory)
        if self.known is not None:
            room = most_made(effort, screened=True)
        return max(more, more + log(FILLED * room / many) / growth)

    def _search_within(self, delta: float, fixing: Fixing, effort: int) -> bool:
        """Look for a plan of flights of a reduced cost up to ``delta``, unless they are too many.

        Returns
        -------
        Whether they were not.
        """
        search = self.search
        delta = min(delta, search.ceiling - fixing.value)
        pool, made = self._listed(delta, fixing, effort)
        if pool is None:
            self.too_wide = delta
            search.note("too many flights within %.3f of %.3f", delta, fixing.value)
            return False
        search.note("%d of %d flights within %.3f of %.3f", len(pool), made, delta, fixing.value)
        self.listed += ((delta, max(1, made)),)
        self._choose(pool, fixing, delta)
        return True

    def _listed(self, delta: float, fixing: Fixing, effort: int) -> tuple[Pool | None, int]:
        """List flights of a reduced cost up to ``delta``, but for those that are screened out.

        Returns
        -------
        The flights, None where they are too many, and how many were made.
        """
        relaxation, clock = self.relaxation, self.search.clock
        networks = fixing.useful(relaxation.pricer.networks, delta)
        screen = self._screen(fixing, delta)
        while True:
            pool, made = enumerate_flights(
                networks, fixing, delta, effort, relaxation.memory, clock,
                apart=self.search.limited, screen=screen,
            )  # fmt: skip
            if pool is None:
                return None, made
            self._require_plan(pool, fixing, delta, screen)
            if screen is None:
                return pool, made
            needed = self._left(screen.prices, fixing, delta) + self._below(screen.prices, pool)
            if needed <= screen.limit:
                return pool, made
            self.search.note("screened beyond %.3f, not %.3f", needed, screen.limit)
            screen = replace(screen, limit=needed)

    def _screen(self, fixing: Fixing, delta: float) -> Screen | None:
        """Return what the prices of the last list leave out, if they are good for the next."""
        if self.known is None:
            return None
        labels = RowDuals(fixing.duals, Rows.subsets(fixing.cuts.triples))
        prices = mixed(MIX, self.known, labels)
        return Screen(prices, SPARE * self._left(prices, fixing, delta))

    def _below(self, prices: RowDuals, pool: Pool) -> float:
        """Return how far flights of one plan fall below zero together, at most.

        Parameters
        ----------
        pool
            All flights that do, among others.
        """
        search = self.search
        slices = pool.slices(search.n, search.clock)
        reduced = reduced_costs(pool, slices, prices.duals, prices.rows, search.clock)
        lower = reduced < 0.0
        return together_below(reduced[lower], pool.kept(lower).members(search.n))

    def _left(self, prices: RowDuals, fixing: Fixing, delta: float) -> float:
        """Return what prices leave up to the target of a list."""
        target = min(fixing.value + delta, self.search.ceiling)
        return max(0.0, target - prices.duals.value(self.relaxation.counts)) + MARGIN

    def _choose(self, pool: Pool, fixing: Fixing, delta: float) -> None:
        """Look for a plan in ``pool``, all flights of a reduced cost up to ``delta``."""
        search, counts = self.search, self.relaxation.counts
        target = min(fixing.value + delta, search.ceiling)
        pool, reduced, rows = self._priced(pool, fixing, delta)
        tight = tighten(pool, reduced, rows, counts, target, search, search.prove)
        self.known = RowDuals(tight.duals, tight.rows)
        if len(tight.pool) > MOST:
            improve(search, self.seed, THOROUGH, self.relaxation.master.rounded())
        if len(tight.pool):
            search.note("%d flights left above %.3f", len(tight.pool), tight.value)
            branch(tight, counts, target, search)

    def _priced(self, pool: Pool, fixing: Fixing, delta: float) -> tuple[Pool, Floats, Rows]:
        """Return flights up to ``delta``, a guess at their reduced costs, and rows to begin with.

        Flights without cycles keep cuts in full, which leaves fewer of them. The guess is by the
        duals of the last list, where there was one.
        """
        clock = self.search.clock
        slices = pool.slices(self.search.n, clock)

        def reduced(duals: Duals, rows: Rows) -> Floats:
            return reduced_costs(pool, slices, duals, rows, clock)

        rows = Rows.subsets(fixing.cuts.triples)
        cost = reduced(fixing.duals, rows)
        keep = cost <= delta + MARGIN
        if self.known is not None:
            duals, rows = self.known
            cost = reduced(duals, rows)
        return pool.kept(keep), cost[keep], rows

    def _require_plan(
        self, pool: Pool, fixing: Fixing, delta: float, screen: Screen | None
    ) -> None:
        """Check that those flights of the best plan are in the pool which must be.

        Raises
        ------
        ProofError
            If one is not: then the search for flights loses some.
        """
        for d, path in self.search.flights:
            time = self.search.networks[d].duration(path)
            within = fixing.reduced_cost(d, path, time) <= delta and (
                screen is None or screen.reduced_cost(d, path, time) <= screen.limit
            )
            if within and not pool.holds(path, time):
                raise ProofError(f"The flight {path} from station {d} is not in the pool.")
