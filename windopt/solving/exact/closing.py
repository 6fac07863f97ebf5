"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta; and the rows that tighten the program over these are those that
a larger delta begins with.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from windopt.solving.exact.branching import MOST, branch
from windopt.solving.exact.enumeration import PAIRS, most_flights
from windopt.solving.exact.fixing import MARGIN, Fixing
from windopt.solving.exact.listing import Size, affordable, list_flights, times_longer
from windopt.solving.exact.local_search import improve
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.pricing import MOST_LABELS
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.row_duals import RowDuals
from windopt.solving.exact.search import Search
from windopt.solving.exact.tightening import tighten

SMALL = 1500
"""Flights of a list few enough to leave them to HiGHS."""
FIRST_PART, LARGER, SMALLER = 0.1, 2.0, 0.5
"""Part of the gap to begin with where the whole is too much, by what it grows, and by what it
shrinks where even the first is too much."""
SHARE = 0.8
"""Part of the time left that a list is expected to take at most, told from the last two."""
FILLED = 0.7
"""Part of the room for flights that the longest list is expected to take."""
WORTHWHILE = 1.08
"""A further list is made only where one is expected to fit that goes this many times as far as is
proved, or all the way."""
SLOWER = 0.5
"""Times as fast as cuts raised the bound that lists must raise it to go on while cuts help."""
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
        Duals and rows of the last list of flights, with which the next begins, and which screen
        it.
    part
        Part of the gap to begin with where the whole is too much.
    too_wide
        The reduced cost up to which flights were too many last.
    listed
        Sizes of the lists since parts of the gap were last begun with.
    between
        Done between two lists, given the time that the second is expected to take [s].
    by_cuts
        By how much cuts raised the bound of the relaxation per second, zero where they no longer
        help.
    """

    relaxation: Relaxation
    seed: int
    fixing: Fixing | None = None
    tried: Duals | None = None
    known: RowDuals | None = None
    part: float = FIRST_PART
    too_wide: float = inf
    listed: tuple[Size, ...] = ()
    between: Callable[[float], None] = lambda ahead: None
    by_cuts: float = 0.0

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

        Where one is too much after others were not, one between the two is the last; and where
        cuts raise the bound much faster, they go on.
        """
        search, part, failed, took = self.search, self.part, inf, inf
        self.listed = ()
        while True:
            search.clock.check()
            delta = self._next(fixing, effort, part, failed, took)
            if took < inf and delta > 0:
                self.between(took * times_longer(self.listed, delta))
                delta = self._next(fixing, effort, part, failed, took)
            if not delta > 0:
                return search.closed
            before, began = search.bound, search.clock.elapsed
            fits = self._search_within(delta, fixing, effort)
            if search.closed or (fits and delta >= search.ceiling - fixing.value):
                return True
            if not fits and part == self.part:
                self.part *= SMALLER
                return False
            if failed < inf:
                return False
            if fits:
                took = search.clock.elapsed - began
                if search.bound - before < SLOWER * self.by_cuts * took:
                    return False
            part = min(1.0, LARGER * part)
            failed = inf if fits else delta

    def _next(self, fixing: Fixing, effort: int, part: float, failed: float, took: float) -> float:
        """Return the gap of the next list, zero where none is worthwhile.

        Parameters
        ----------
        part
            Of what is left, to close.
        failed
            The gap whose flights were too many, infinite if none.
        took
            The time that the last list took [s].
        """
        search = self.search
        proved, whole = max(0.0, search.bound - fixing.value), search.ceiling - fixing.value
        most = min(self._affordable(effort), self._in_time(took))
        if search.closed or most < min(WORTHWHILE * proved, whole):
            return 0.0
        wanted = proved + part * (search.ceiling - search.bound)
        return min(wanted, proved + SMALLER * (failed - proved), most)

    def _affordable(self, effort: int) -> float:
        """Return the gap whose flights are expected to take much of the room and work for them."""
        room = most_flights(self.search.n, effort, self.relaxation.memory)
        return affordable(self.listed, FILLED * room, FILLED * PAIRS * effort)

    def _in_time(self, took: float) -> float:
        """Return the gap whose list is expected to take a part of the time left.

        Parameters
        ----------
        took
            The time that the last list took [s].
        """
        if not self.listed:
            return inf
        more = SHARE * self.search.clock.left / took
        return affordable(self.listed, inf, max(1.0, more * self.listed[-1].pairs))

    def _search_within(self, delta: float, fixing: Fixing, effort: int) -> bool:
        """Look for a plan of flights of a reduced cost up to ``delta``, unless they are too many.

        Returns
        -------
        Whether they were not.
        """
        search = self.search
        delta = min(delta, search.ceiling - fixing.value)
        listing = list_flights(self.relaxation, fixing, delta, effort, self.known)
        if listing is None:
            self.too_wide = delta
            search.note("too many flights within %.3f of %.3f", delta, fixing.value)
            return False
        size = len(listing.pool), listing.pairs
        search.note("%d flights, of %d pairs, within %.3f of %.3f", *size, delta, fixing.value)
        self.listed += (listing.size(delta),)
        self._choose(listing.pool, fixing, delta)
        return True

    def _choose(self, pool: Pool, fixing: Fixing, delta: float) -> None:
        """Look for a plan below ``fixing.value`` + ``delta``, whose flights are all in ``pool``."""
        search, counts = self.search, self.relaxation.counts
        target = min(fixing.value + delta, search.ceiling)
        pool, reduced, rows = self._priced(pool, fixing, delta)
        tight = tighten(pool, reduced, rows, counts, target, search, search.prove, SMALL)
        self.known = RowDuals(tight.duals, tight.rows)
        if len(tight.pool) > MOST and target == search.ceiling:
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

        duals, rows = fixing.in_full
        cost = reduced(duals, rows)
        keep = cost <= delta + MARGIN
        if self.known is not None:
            duals, rows = self.known
            cost = reduced(duals, rows)
        return pool.kept(keep), cost[keep], rows
