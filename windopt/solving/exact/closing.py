"""Closing the gap: all flights within it in hand, or all within a part of it.

A plan cheaper than value + delta flies only flights of reduced cost up to delta. Where the flights
of the whole gap are too many, those of a smaller delta either hold a better plan, and the gap
shrinks, or prove value + delta; and the rows that tighten the program over these are those that
a larger delta begins with.
"""

from dataclasses import dataclass

from windopt.solving.exact.branching import MOST, branch
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.local_search import improve
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Floats
from windopt.solving.exact.pool import Pool, reduced_costs
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.relaxation import MARGIN, Fixing, Relaxation
from windopt.solving.exact.search import ProofError, Search
from windopt.solving.exact.tightening import Tightened, tighten

LEAST, LARGER = 0.1, 1.5
"""Part of the gap to begin with where the whole is too much, and by what it grows."""
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
        The last that there was memory for; it holds when the relaxation has gone on.
    tight
        The last list of flights, tightened.
    """

    relaxation: Relaxation
    seed: int
    fixing: Fixing | None = None
    tight: Tightened | None = None

    @property
    def search(self) -> Search:
        """The search to close."""
        return self.relaxation.search

    def close(self, effort: int, *, in_parts: bool) -> bool:
        """Find the best plan, and that there is no better one, unless flights are too many.

        Parameters
        ----------
        effort
            Half flights to hold at most, for one side of one station; memory may allow fewer.
        in_parts
            Whether to close parts of the gap where the whole is too much.

        Returns
        -------
        Whether the gap is closed.
        """
        if self.search.closed:
            return True
        fixing = None if self.relaxation.crowded else self.relaxation.fix_arcs()
        if fixing is not None:
            self.fixing = fixing
            if self._list(fixing, self.search.ceiling - fixing.value, effort):
                return True
        if not in_parts or self.fixing is None:
            return False
        return self._close_parts(self.fixing, effort)

    def _close_parts(self, fixing: Fixing, effort: int) -> bool:
        """Close ever larger parts of the gap, and tell whether that came to the whole."""
        search = self.search
        delta = search.bound - fixing.value + LEAST * (search.ceiling - search.bound)
        while self._list(fixing, delta, effort):
            if search.closed or delta >= search.ceiling - fixing.value:
                return True
            delta *= LARGER
        return False

    def _list(self, fixing: Fixing, delta: float, effort: int) -> bool:
        """Look for a plan of flights of a reduced cost up to ``delta``, unless they are too many.

        Returns
        -------
        Whether they were not.
        """
        search, relaxation = self.search, self.relaxation
        delta = min(delta, search.ceiling - fixing.value)
        networks = fixing.useful(relaxation.pricer.networks, delta)
        pool = enumerate_flights(
            networks, fixing, delta, effort, relaxation.memory, search.clock, apart=search.limited
        )
        if pool is None:
            search.note("too many flights within %.3f of %.3f", delta, fixing.value)
            return False
        search.note("%d flights within %.3f of %.3f", len(pool), delta, fixing.value)
        self._require_plan(pool, fixing, delta)
        self._choose(pool, fixing, delta)
        return True

    def _choose(self, pool: Pool, fixing: Fixing, delta: float) -> None:
        """Look for a plan in ``pool``, all flights of a reduced cost up to ``delta``."""
        search, counts = self.search, self.relaxation.counts
        target = min(fixing.value + delta, search.ceiling)
        pool, reduced, rows = self._priced(pool, fixing, delta)
        self.tight = tighten(pool, reduced, rows, counts, target, search, search.prove)
        left = len(self.tight.pool)
        if left > MOST:
            improve(search, self.seed, THOROUGH, self.relaxation.rounded())
        if left:
            search.note("%d flights left above %.3f", left, self.tight.value)
            branch(self.tight, counts, target, search)

    def _priced(self, pool: Pool, fixing: Fixing, delta: float) -> tuple[Pool, Floats, Rows]:
        """Return the flights up to ``delta``, a guess at their reduced costs, and rows to keep.

        Cuts of the relaxation count in full here, which leaves fewer flights.
        """
        clock = self.search.clock
        slices = pool.slices(self.search.n, clock)

        def reduced(duals: Duals, rows: Rows) -> Floats:
            return reduced_costs(pool, slices, duals, rows, clock)

        rows = Rows.subsets(fixing.cuts.triples)
        cost = reduced(fixing.duals, rows)
        keep = cost <= delta + MARGIN
        if self.tight is not None:
            rows, cost = self.tight.rows, reduced(self.tight.duals, self.tight.rows)
        return pool.kept(keep), cost[keep], rows

    def _require_plan(self, pool: Pool, fixing: Fixing, delta: float) -> None:
        """Check that those flights of the best plan are in the pool which must be.

        Raises
        ------
        ProofError
            If one is not: then the search for flights loses some.
        """
        for d, path in self.search.flights:
            time = self.search.networks[d].duration(path)
            if fixing.reduced_cost(d, path, time) <= delta and not pool.holds(path, time):
                raise ProofError(f"The flight {path} from station {d} is not in the pool.")
