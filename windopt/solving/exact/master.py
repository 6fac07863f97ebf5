"""The master: the linear relaxation over the flights found so far, and its duals."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, hstack, vstack

from formulations.set_partitioning import SetPartitioning, set_partitioning
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.network import Bools, Floats, Network
from windopt.solving.exact.search import Flight
from windopt.solving.exact.subset_row_cuts import Column, Cuts, Path

DUAL, PRIMAL = 1, 4
"""Strategies of HiGHS's simplex method: for rows that were added, and for columns."""
MISSING = 5.0
"""Cost of leaving out a turbine that must not be, in t_max: more than any flight saves by it."""


@dataclass(frozen=True)
class Duals:
    """Duals of the master, or any mix of several.

    Parameters
    ----------
    pi
        Reward of each turbine, not negative, shape ``(n,)``.
    sigma
        Price of a flight from each station, and of any flight, shape ``(k + 1,)``.
    penalty
        Price of each subset-row cut, not negative, shape ``(cuts,)``.
    reward
        Price of a flight into each crowded set, not negative, shape ``(sets,)``.
    crowded
        Those sets.
    """

    pi: Floats
    sigma: Floats
    penalty: Floats
    reward: Floats
    crowded: CrowdedSets

    @cached_property
    def grant(self) -> Floats:
        """What crowded sets grant for flying each leg, the station last; ``(n + 1, n + 1)``."""
        return self.crowded.grants(self.reward)

    @classmethod
    def of(cls, program: SetPartitioning, price: Floats, crowded: CrowdedSets) -> Self:
        """Return the duals of a program that is solved, to which the solver keeps but for rounding.

        Parameters
        ----------
        price
            Of leaving each turbine out, which none is worth more than.
        crowded
            The sets of the rows of crowded sets.
        """
        dual = program.model.getSolution().row_dual
        pi, sigma, penalty, reward = program.by_equation(dual)
        pi, reward = np.clip(pi, 0.0, price), np.maximum(reward, 0.0)
        return cls(pi, sigma, np.maximum(-penalty, 0.0), reward, crowded)

    @property
    def toll(self) -> Floats:
        """Price of a flight from each station, shape ``(k,)``."""
        toll: Floats = self.sigma[:-1] + self.sigma[-1]
        return toll

    def value(self, counts: Floats) -> float:
        """Return the bound these duals prove when no flight has a negative reduced cost."""
        tight = np.where(self.sigma > 0, counts[:, 0], counts[:, 1])
        paid = np.where(self.sigma == 0.0, 0.0, self.sigma) @ np.where(self.sigma == 0, 0.0, tight)
        entered = self.reward @ self.crowded.need
        return float(self.pi.sum() - self.penalty.sum() + entered + paid)


class Master:
    """Set partitioning, relaxed to covering, over a growing list of columns.

    Parameters
    ----------
    networks
        One for each station.
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    prize
        Cost of leaving each turbine out, infinite where it must be inspected; shape ``(n,)``.
    """

    def __init__(
        self,
        networks: list[Network],
        counts: Floats,
        prize: Floats,
    ) -> None:
        self.networks = networks
        self.counts = counts
        longest = max(network.t_max for network in networks)
        self.price = np.where(np.isfinite(prize), prize, MISSING * longest)
        self.cuts = Cuts.none(len(networks[0].out))
        self.crowded = CrowdedSets.none(len(networks[0].out))
        self.columns: list[Column] = []
        self._known: set[tuple[int, Path]] = set()
        self.x = np.zeros(0)
        self.value = 0.0
        self._program: SetPartitioning
        self._strategy = DUAL
        self.rebuild(())

    @property
    def n(self) -> int:
        """Number of turbines."""
        return len(self.networks[0].out)

    def column(self, station: int, path: Path) -> Column:
        """Return the column of one flight."""
        return Column(station, path, self.networks[station].duration(path))

    def rebuild(
        self,
        columns: Iterable[Column],
        cuts: Cuts | None = None,
        crowded: CrowdedSets | None = None,
    ) -> None:
        """Start anew with ``columns`` and, where given, ``cuts`` and ``crowded``."""
        columns = list(columns)
        cuts = self.cuts if cuts is None else cuts
        crowded = self.crowded if crowded is None else crowded
        self._program = set_partitioning(
            self.n, self.counts, integer=False, cover=True, price=self.price
        )
        self.columns, self._known, self.x = [], set(), np.zeros(0)
        self.cuts, self.crowded = Cuts.none(self.n), CrowdedSets.none(self.n)
        self.cut(cuts)
        self.enter(crowded)
        self.add(columns)

    def recount(self, counts: Floats) -> None:
        """Change how many flights may be sent."""
        self.counts = counts
        rows = np.arange(self.n, self.n + len(counts), dtype=np.int32)
        lower, upper = np.ascontiguousarray(counts.T)
        self._program.model.changeRowsBounds(len(rows), rows, lower, upper)
        self._strategy = DUAL

    def add(self, columns: Iterable[Column]) -> int:
        """Add the columns that are not there yet, and return how many."""
        new = []
        for column in columns:
            if (column.station, column.path) not in self._known:
                self._known.add((column.station, column.path))
                new.append(column)
        if new:
            cost = np.array([column.cost for column in new])
            self._program.add_flights(cost, self._matrix(new))
            self.columns += new
            self._strategy = PRIMAL if len(self.x) else DUAL
        return len(new)

    def restrict(self, networks: list[Network]) -> None:
        """Drop the columns that fly legs which ``networks`` leave out."""
        self.networks = networks
        flown = (
            all(networks[column.station].arcs[i, j] for i, j in pairwise(column.path))
            for column in self.columns
        )
        self.keep(np.fromiter(flown, bool))

    def keep(self, keep: Bools) -> None:
        """Drop the columns where ``keep`` does not hold."""
        gone = (self.n + np.flatnonzero(~keep)).astype(np.int32)
        self._program.model.deleteCols(len(gone), gone)
        self.columns = [self.columns[r] for r in np.flatnonzero(keep)]
        self._known = {(column.station, column.path) for column in self.columns}
        self.x = self.x[keep[: len(self.x)]]

    def keep_cheapest(self, number: int) -> None:
        """Keep the columns of least reduced cost: the basis among them, if it is no larger."""
        keep = np.zeros(len(self.columns), bool)
        keep[np.argsort(self.reduced_costs(), kind="stable")[:number]] = True
        self.keep(keep)

    def cut(self, cuts: Cuts) -> None:
        """Add subset rows."""
        coefficients = cuts.coefficients([column.path for column in self.columns])
        self._program.add_subset_rows(csr_array(np.pad(coefficients, ((0, 0), (self.n, 0)))))
        self.cuts = self.cuts.joined(cuts)
        self._strategy = DUAL

    def keep_cuts(self, keep: Bools) -> None:
        """Drop the subset rows where ``keep`` does not hold."""
        self._program.keep_subset_rows(keep)
        self.cuts = self.cuts.kept(keep)

    def enter(self, crowded: CrowdedSets) -> None:
        """Add rows of crowded sets."""
        entries = crowded.entries([column.path for column in self.columns])
        coefficients = hstack([crowded.left_out, csr_array(entries)])
        self._program.add_entry_rows(csr_array(coefficients), crowded.need)
        self.crowded = self.crowded.joined(crowded)
        self._strategy = DUAL

    def keep_crowded(self, keep: Bools) -> None:
        """Drop the rows of crowded sets where ``keep`` does not hold."""
        self._program.keep_entry_rows(keep)
        self.crowded = self.crowded.kept(keep)

    def _matrix(self, columns: list[Column]) -> csc_array:
        lengths = [len(column.path) for column in columns]
        visited = np.array([i for column in columns for i in column.path], np.int32)
        flights = np.repeat(np.arange(len(columns)), lengths)
        visits = csc_array(
            (np.ones(len(visited)), (visited, flights)), shape=(self.n, len(columns))
        )
        stations = np.array([column.station for column in columns])
        sent = np.zeros((len(self.counts), len(columns)))
        sent[stations, np.arange(len(columns))] = 1.0
        sent[-1] = 1.0
        paths = [column.path for column in columns]
        entries, cut = self.crowded.entries(paths), self.cuts.coefficients(paths)
        blocks = (sent, cut, entries)
        return csc_array(vstack([visits, *(csc_array(block) for block in blocks)]))

    def solve(self, clock: Clock) -> Duals:
        """Solve the relaxation and return its duals."""
        model = self._program.model
        model.setOptionValue("simplex_strategy", self._strategy)
        clock.run(model)
        solution = model.getSolution()
        values = np.array(solution.col_value)
        self.x = values[self.n :]
        self.value = model.getInfo().objective_function_value
        return Duals.of(self._program, self.price, self.crowded)

    def reduced_costs(self) -> Floats:
        """Return the reduced cost of each column."""
        return np.array(self._program.model.getSolution().col_dual)[self.n :]

    def flown(self) -> list[tuple[Column, float]]:
        """Return the columns the relaxation uses, and how much of each."""
        return [(self.columns[r], float(self.x[r])) for r in np.flatnonzero(self.x > 1e-7)]

    def rounded(self) -> list[Flight]:
        """Return flights that do not meet, those first which the relaxation flies most of."""
        flights: list[Flight] = []
        visited: set[int] = set()
        left = self.counts[:-1, 1].copy()
        for column, _ in sorted(self.flown(), key=lambda flown: -flown[1]):
            again = len(set(column.path)) < len(column.path) or visited & set(column.path)
            if not again and left[column.station] > 0:
                flights.append((column.station, column.path))
                visited |= set(column.path)
                left[column.station] -= 1
        return flights
