"""Selection: a linear program over those flights of a list that seem to matter."""

import highspy
import numpy as np
from scipy.sparse import csc_array, csr_array, hstack, vstack

from formulations.set_partitioning import set_partitioning
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.labels import Ints
from windopt.solving.exact.master import DUAL, PRIMAL, Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.pool import Pool
from windopt.solving.exact.rank_one_rows import Rows


class Selection:
    """A linear program over the flights of a pool that seem to matter.

    Where flights are too few for those that must be sent, idle ones, which visit nothing, make up
    the number, so that there always is a solution. They come first, one of each station.

    Parameters
    ----------
    rows
        Rank-one rows to begin with.
    price
        Of leaving each turbine out, shape ``(n,)``.
    idle_cost
        Time of an idle flight, at least that of any plan of interest.
    crowded
        Sets of turbines that need several flights.
    """

    def __init__(
        self,
        n: int,
        counts: Floats,
        rows: Rows,
        price: Floats,
        idle_cost: float,
        crowded: CrowdedSets,
    ) -> None:
        self.n, self.counts, self.rows, self.price = n, counts, rows, price
        self.crowded = crowded
        idle = len(counts) - 1
        self.members: Bools = np.zeros((idle, n), bool)
        self.station: Ints = np.arange(idle, dtype=np.int32)
        self._program = set_partitioning(n, counts, integer=False, cover=True, price=price)
        none = rows.kept(np.zeros(0, np.intp))
        self._program.add_entry_rows(crowded.left_out, crowded.need)
        coefficients = flight_rows(self.members, self.station, len(counts), none, crowded)
        self._program.add_flights(np.full(idle, idle_cost), coefficients)
        self._program.add_subset_rows(csr_array((rows.m, n + idle)))

    def add(self, pool: Pool) -> None:
        """Add the flights of ``pool``."""
        warm = len(self.members) >= len(self.counts)  # columns leave the last basis feasible
        self._program.model.setOptionValue("simplex_strategy", PRIMAL if warm else DUAL)
        members = pool.members(self.n)
        coefficients = flight_rows(members, pool.station, len(self.counts), self.rows, self.crowded)
        self._program.add_flights(pool.cost, coefficients)
        self.members = np.vstack([self.members, members])
        self.station = np.concatenate([self.station, pool.station])

    def cut(self, rows: Rows) -> None:
        """Add rows."""
        self._program.model.setOptionValue("simplex_strategy", DUAL)
        flights = csr_array(rows.coefficients(self.members).T)
        left_out = csr_array((rows.m, self.n))
        self._program.add_subset_rows(csr_array(hstack([left_out, flights])))
        self.rows = self.rows.joined(rows)

    def keep_flights(self, keep: Bools) -> None:
        """Keep these flights, idle ones among them."""
        gone = (self.n + np.flatnonzero(~keep)).astype(np.int32)
        self._program.model.deleteCols(len(gone), gone)
        self.members, self.station = self.members[keep], self.station[keep]

    def reduced_costs(self) -> Floats:
        """Return the reduced cost of each flight."""
        return np.array(self._program.model.getSolution().col_dual)[self.n :]

    def keep_rows(self, keep: Bools) -> None:
        """Keep these rows; the others must have no price."""
        self._program.keep_subset_rows(keep)
        self.rows = self.rows.kept(keep)

    def solve(self, clock: Clock) -> tuple[Duals, Floats]:
        """Return duals and flights flown."""
        model = self._program.model
        clock.run(model)
        duals = Duals.of(self._program, self.price, self.crowded)
        return duals, np.array(model.getSolution().col_value)[self.n :]

    def value_with(self, keep: Bools, counts: Floats, iterations: int, clock: Clock) -> float:
        """Return what the program's value rises to with fewer flights and other counts.

        Parameters
        ----------
        keep
            Flights that stay, all others are dropped.
        iterations
            Of the dual simplex, after which the value reached so far is returned.
        """
        model = self._program.model
        if not model.getBasis().valid:  # rows or flights have left it since
            clock.run(model)
        basis = model.getBasis()
        clock.check()
        rows = np.arange(self.n, self.n + len(counts), dtype=np.int32)
        dropped = (self.n + np.flatnonzero(~keep)).astype(np.int32)
        nothing = np.zeros(len(dropped))
        model.changeRowsBounds(len(rows), rows, counts[:, 0].copy(), counts[:, 1].copy())
        model.changeColsBounds(len(dropped), dropped, nothing, nothing)
        model.setOptionValue("simplex_strategy", DUAL)
        model.setOptionValue("simplex_iteration_limit", iterations)
        model.setOptionValue("time_limit", model.getRunTime() + clock.left)
        model.run()
        infeasible = model.getModelStatus() == highspy.HighsModelStatus.kInfeasible
        value = np.inf if infeasible else float(model.getInfo().objective_function_value)
        own = self.counts
        model.changeRowsBounds(len(rows), rows, own[:, 0].copy(), own[:, 1].copy())
        model.changeColsBounds(len(dropped), dropped, nothing, np.full(len(dropped), np.inf))
        model.setOptionValue("simplex_iteration_limit", highspy.kHighsIInf)
        model.setBasis(basis)
        return value


def flight_rows(
    members: Bools, station: Ints, counts: int, rows: Rows, crowded: CrowdedSets
) -> csc_array:
    """Return the coefficients of flights in all rows of the set-partitioning program.

    A flight enters a crowded set once: it counts for no more however often it does.
    """
    sent = np.zeros((counts, len(members)))
    sent[station, np.arange(len(members))] = 1.0
    sent[-1] = 1.0
    visits, entered = members.T.astype(float), crowded.visited(members)
    blocks = [visits, sent, rows.coefficients(members).T, entered]
    return csc_array(vstack([csc_array(block) for block in blocks]))
