"""What remains in a case of a proof: flights, and how many of them may be sent."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from windopt.checking.flight_list import FlightList
from windopt.domain.certificate import Question, Round, Together
from windopt.domain.plan import InspectionPlan

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Terms:
    """What plans keep to beside the times of their flights.

    Parameters
    ----------
    worth
        What leaving each turbine out costs [s], ``inf`` where it must be inspected; shape ``(n,)``.
    counts
        Least and largest number of flights of each station, and of all, shape ``(k + 1, 2)``.
    """

    worth: Floats
    counts: Floats

    @classmethod
    def of(cls, plan: InspectionPlan, turbines: Sequence[str]) -> "Terms":
        """Return the terms of a plan, for ``turbines`` in their order."""
        worth = dict(zip(plan.farm.names, plan.worth or [inf] * len(plan.farm), strict=True))
        most = [station.max_flights for station in plan.fleet.stations]
        counts = [(0.0, inf if number is None else float(number)) for number in (*most, None)]
        return cls(np.array([worth[name] for name in turbines]), np.array(counts))

    @property
    def limited(self) -> bool:
        """Whether a station may run out of flights, so that it matters which one flies."""
        return bool(np.isfinite(self.counts[:, 1]).any())

    def earned(self, given: Round) -> float:
        """Return what a round proves if no reduced cost is negative [s]; ``-inf`` for nothing.

        A turbine pays its price by a flight, or its worth where it is left out.
        """
        least, most = self.counts.T
        charged = given.tolls != 0.0
        numbers = np.where(given.tolls > 0, least, most)[charged]
        prices = np.minimum(given.prices, self.worth)
        return float(prices.sum() - given.penalties.sum() + given.tolls[charged] @ numbers)


@dataclass(frozen=True, eq=False)
class Remaining:
    """The flights and the terms of a case."""

    flights: FlightList
    terms: Terms

    def impossible(self) -> bool:
        """Tell whether a turbine that needs one, or a station that must send one, has no flight."""
        least, most = self.terms.counts.T
        senders = np.bincount(self.flights.station, minlength=len(least) - 1) > 0
        unvisited = np.isinf(self.terms.worth) & ~self.flights.visited_at_all()
        return bool((least > most).any() or ((least[:-1] > 0) & ~senders).any() or unvisited.any())

    def after(self, given: Round, bound: float, margin: float) -> tuple[float, "Remaining"]:
        """Return what a round proves, and what remains of the flights for ``bound``."""
        reduced = self.flights.reduced_costs(given)
        value = self.terms.earned(given) + self.flights.n * float(reduced.min(initial=0.0))
        kept = self.flights.kept(reduced <= bound - value + margin)
        return value, replace(self, flights=kept)

    def parted(self, question: Question) -> tuple["Remaining", "Remaining"]:
        """Return what remains where the answer is yes, and where it is no."""
        if isinstance(question, Together):
            one, other = self.flights.visit(question.first), self.flights.visit(question.second)
            yes, no = self.flights.kept(one == other), self.flights.kept(~(one & other))
            return replace(self, flights=yes), replace(self, flights=no)
        which, most = question.station, question.most
        fewer, more = self.terms.counts.copy(), self.terms.counts.copy()
        fewer[which, 1], more[which, 0] = min(fewer[which, 1], most), max(more[which, 0], most + 1)
        terms = replace(self.terms, counts=fewer), replace(self.terms, counts=more)
        return replace(self, terms=terms[0]), replace(self, terms=terms[1])
