"""Crowding: which turbines need several flights, proved, and where a plan sends fewer.

Sets are guessed (:mod:`windopt.solving.exact.grown_sets`) and proved by a linear program
(:mod:`formulations.few_flights`). A set that holds a crowded one is as crowded, and of all that do
a minimum cut is the one into which least flies.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import highspy
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_flow, shortest_path

from formulations.few_flights import few_flights
from formulations.subtours import SCALE, sink_side
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.grown_sets import Flow, grown_sets
from windopt.solving.exact.network import SLACK, Bools, Floats, Network
from windopt.solving.exact.search import Flight
from windopt.solving.exact.tours import FAR
from windopt.solving.rows import rows

SURELY = 1e-3
"""By how much few flights must last too long, for the rounding of linear programs."""
PROOFS = 12
"""Sets to try to prove crowded, at most, before rows are added."""
ROWS = 15
"""Rows to add at most."""
LACKING = 0.1
"""Flights that must be lacking in a set for its row to be added."""


@dataclass
class Crowding:
    """What is known of how many flights sets of turbines need.

    Flights are made as easy as those from any station: their legs take the least time of any UAV,
    by any way, and they last as long as the longest.

    Parameters
    ----------
    t
        Times of such flights, in thousandths of the longest t_max, shape ``(n + 1, n + 1)``; the
        station is the last node.
    longest
        How long they last at most, likewise.
    usable
        Turbines that must be visited, shape ``(n,)``; no others are in a set that is proved, though
        some may be in those around it.
    proved, refuted
        Sets known to need so many flights, and sets of which that could not be proved.
    rounds
        How often plans were looked at, which seeds the search for sets.
    """

    t: Floats
    longest: float
    usable: Bools
    clock: Clock
    proved: CrowdedSets = field(init=False)
    refuted: CrowdedSets = field(init=False)
    rounds: int = 0

    def __post_init__(self) -> None:
        self.proved = self.refuted = CrowdedSets.none(len(self.usable))

    @classmethod
    def of(cls, networks: list[Network], usable: Bools, clock: Clock) -> "Crowding":
        """Begin to learn about the turbines of some stations."""
        n = len(usable)
        t = np.zeros((n + 1, n + 1))
        t[-1, :-1] = np.minimum.reduce([network.backward.rest for network in networks])
        t[:-1, -1] = np.minimum.reduce([network.forward.rest for network in networks])
        t[:-1, :-1] = np.minimum.reduce([_by_any_way(network.legs) for network in networks])
        longest = max(network.t_max for network in networks)
        return cls(np.minimum(t, FAR), longest, usable, clock)

    def lacking(self, flown: list[tuple[Flight, float]]) -> CrowdedSets:
        """Return sets into which a fractional plan sends fewer flights than they need.

        Parameters
        ----------
        flown
            The flights of the plan, and how much of each is flown.
        """
        x = _flow(flown, len(self.usable))
        self._learn(x)
        found = CrowdedSets.none(len(self.usable))
        missing = np.zeros(0)
        for core, need in zip(self.proved.sets, self.proved.need, strict=True):
            inside = _least_entered(x, core)
            lacks = need - x[np.append(~inside, True)][:, :-1][:, inside].sum()
            known = (found.sets == inside).all(axis=1) & (found.need >= need)
            if lacks > LACKING and not known.any():
                found = found.joined(CrowdedSets(inside[None], np.array([need])))
                missing = np.append(missing, lacks)
        worst = np.zeros(len(found), bool)
        worst[np.argsort(-missing, kind="stable")[:ROWS]] = True
        return found.kept(worst)

    def _learn(self, x: Floats) -> None:
        """Try to prove that sets are crowded into which little flies."""
        self.rounds += 1
        turbines = x[:-1, :-1]
        flow = Flow(turbines + turbines.T, x[:, :-1].sum(axis=0))
        [grown] = self.clock.map(
            grown_sets,
            [flow], [self.t], [self.longest], [self.usable], [self.rounds], [self.clock.stop],
        )  # fmt: skip
        tried = 0
        for row in np.argsort(-grown.lacking, kind="stable"):
            if tried == PROOFS:
                break
            tried += self._try(grown.sets[row], float(grown.need[row]))

    def _try(self, inside: Bools, need: float) -> bool:
        """Learn whether ``inside`` needs ``need`` flights; tell whether that was news."""
        more, less = self.proved, self.refuted
        known = (more.need >= need) & ~(more.sets & ~inside).any(axis=1)
        hopeless = (less.need <= need) & ~(inside & ~less.sets).any(axis=1)
        if known.any() or hopeless.any():
            return False
        case = CrowdedSets(inside[None].copy(), np.array([need]))
        if self._fewer_do_not_do(inside, int(need) - 1):
            self.proved = self.proved.joined(case)
        else:
            self.refuted = self.refuted.joined(case)
        return True

    def _fewer_do_not_do(self, inside: Bools, flights: int) -> bool:
        """Prove that ``flights`` do not serve the turbines ``inside``, or fail to."""
        nodes = np.append(len(inside), np.flatnonzero(inside))  # the station first
        program = few_flights(self.t[np.ix_(nodes, nodes)], self.longest + SLACK, flights)
        while True:
            self.clock.run(program.model)
            if _proved(program.model) > SURELY:
                return True
            if not program.cut():
                return False


def _proved(model: highspy.Highs) -> float:
    """Return the bound that the duals of a program prove, whatever rounding they bear.

    No leg is flown more than once: its turbine is visited but once.
    """
    lp = model.getLp()
    given, cost = rows(lp), np.array(lp.col_cost_)
    dual = np.array(model.getSolution().row_dual)
    dual = np.where((dual < 0.0) & np.isinf(given.row_upper), 0.0, dual)
    sides = np.where(dual > 0.0, given.row_lower, np.where(dual < 0.0, given.row_upper, 0.0))
    return float(dual @ sides + np.minimum(cost - given.A.T @ dual, 0.0).sum())


def _by_any_way(legs: Floats) -> Floats:
    """Return the least time between turbines, calling at others where that is faster."""
    flown = np.where(np.isfinite(legs), np.maximum(legs, 1e-12), 0.0)  # zero: no leg
    least: Floats = shortest_path(csr_array(flown))
    return least


def _flow(flown: list[tuple[Flight, float]], n: int) -> Floats:
    """Return how much of a plan flies each leg, the station last, shape ``(n + 1, n + 1)``."""
    x = np.zeros((n + 1, n + 1))
    for (_, path), share in flown:
        for i, j in pairwise((n, *path, n)):
            x[i, j] += share
    return x


def _least_entered(x: Floats, core: Bools) -> Bools:
    """Return the set around ``core`` into which least of ``x`` flies."""
    others = np.append(np.flatnonzero(~core), len(core))  # the station last of these
    capacity = np.zeros((len(others) + 1, len(others) + 1))
    capacity[:-1, :-1] = x[np.ix_(others, others)]
    capacity[:-1, -1] = x[others][:, :-1][:, core].sum(axis=1)
    np.fill_diagonal(capacity, 0.0)
    network = csr_array(np.rint(SCALE * capacity).astype(np.int32))
    station, sink = len(others) - 1, len(others)
    flow = maximum_flow(network, station, sink).flow
    near = sink_side(csr_array(network - flow), sink)
    inside = core.copy()
    inside[others[[node for node in near if node < station]]] = True
    return inside
