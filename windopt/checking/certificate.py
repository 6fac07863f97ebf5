"""Whether a certificate proves its bound, by other means than those that found it.

Nothing in a certificate is taken on trust. Where a reduced cost is negative after all, the bound is
lowered by as much as that can matter: a plan has no more flights than turbines.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from windopt.checking.cheap_flights import cheap_flights
from windopt.checking.flight_list import FlightList
from windopt.checking.report import Report
from windopt.checking.tails import TooMany
from windopt.checking.times import times_of_legs
from windopt.domain.certificate import Case, Certificate, Question, Round, Together
from windopt.domain.plan import InspectionPlan

TOLERANCE = 1e-7
"""Part of the bound that a proof may lack."""
MARGIN = 1e-8
"""Part of the bound that gaps are widened by before flights are dropped: far more than rounding."""
OVERSTATED = 1e-6
"""Relative; what a bound may exceed its proof by, as it may exceed an objective."""


def check_certificate(plan: InspectionPlan, bound: float, certificate: Certificate) -> Report:
    """Verify that no plan for the farm, fleet and wind of ``plan`` takes less than ``bound`` [s].

    Plans are those that visit the turbines which ``plan`` visits.
    """
    strangers = tuple(_strangers(plan, certificate))
    if strangers:
        return Report(strangers)
    proved = certificate.proof.bound
    violations = []
    if bound > proved + OVERSTATED * max(1.0, proved):
        violations.append(f"a bound of {bound:.9g} s is claimed, {proved:.9g} s is certified")
    try:
        faults, told = _faults(plan, certificate)
    except TooMany:
        cannot = "the flights that matter are too many to be listed here"
        return Report(tuple(violations), unverified=(cannot,))
    violations += faults
    return Report(tuple(violations), proved=() if violations else (told,))


def _strangers(plan: InspectionPlan, certificate: Certificate) -> Iterator[str]:
    """Names that are not those of the plan."""
    visited = sorted(name for flight in plan.flights for name in flight.turbines)
    if sorted(certificate.turbines) != visited:
        yield "it is not about the turbines that the plan visits"
    if certificate.stations != plan.fleet.names:
        yield "it is not about the stations of the plan"


def _faults(plan: InspectionPlan, certificate: Certificate) -> tuple[list[str], str]:
    """Return what the proof lacks, a sentence each, and the proof in a sentence."""
    proof, n, k = certificate.proof, len(certificate.turbines), len(certificate.stations)
    none = np.zeros((0, 3), np.int64)
    first = Round(proof.prices, np.zeros(k + 1), none, np.zeros(0))
    anywhere = np.tile([0.0, inf], (k + 1, 1))
    limit = max(0.0, proof.bound - proof.prices.sum()) + MARGIN * proof.bound
    times = times_of_legs(plan, certificate.turbines)
    left = _Left(cheap_flights(times, proof.prices, proof.neighbours, limit), anywhere)
    least = left.flights.reduced_costs(first).min(initial=0.0)
    if n * least < -MARGIN * proof.bound:
        return [f"at the first prices a flight has the reduced cost {least:.6g} s"], ""
    value = proof.prices.sum() + n * least
    faults = []
    if value < proof.bound * (1 - TOLERANCE):
        faults = [
            f"its {where} proves {proved:.9g} s only"
            for where, proved in _open_cases(proof.case, left, value, proof.bound, "case")
        ]
    cases = list(proof.case.all())
    rounds = 1 + sum(len(case.rounds) for case in cases)
    told = (
        f"no plan takes less than {proof.bound:.2f} s: prices leave {len(left.flights)} flights "
        f"of all that there are; rounds {rounds}, cases {len(cases)}"
    )
    return faults, told


@dataclass(frozen=True, eq=False)
class _Left:
    """What is left in a case: flights, and the least and largest number that may be sent.

    Parameters
    ----------
    counts
        By each station, and of all, shape ``(k + 1, 2)``.
    """

    flights: FlightList
    counts: NDArray[np.float64]

    def impossible(self) -> bool:
        """Tell whether a turbine has no flight, or a station none that it must send."""
        least, most = self.counts.T
        there = np.bincount(self.flights.station, minlength=len(least) - 1) > 0
        lacking = (least[:-1] > 0) & ~there
        return bool((least > most).any() or lacking.any()) or not self.flights.complete()

    def after(self, given: Round, bound: float) -> tuple[float, "_Left"]:
        """Return what a round proves, and what it leaves."""
        least, most = self.counts.T
        paid = given.tolls != 0.0
        tight = np.where(given.tolls > 0, least, most)[paid]
        value = given.prices.sum() - given.penalties.sum() + given.tolls[paid] @ tight
        reduced = self.flights.reduced_costs(given)
        value += self.flights.n * reduced.min(initial=0.0)
        keep = reduced <= bound - value + MARGIN * bound
        return float(value), _Left(self.flights.kept(keep), self.counts)

    def parted(self, question: Question) -> tuple["_Left", "_Left"]:
        """Return what is left where the answer is yes, and where it is no."""
        if isinstance(question, Together):
            one, other = self.flights.visit(question.first), self.flights.visit(question.second)
            yes, no = self.flights.kept(one == other), self.flights.kept(~(one & other))
            return _Left(yes, self.counts), _Left(no, self.counts)
        fewer, more = self.counts.copy(), self.counts.copy()
        fewer[question.station, 1] = min(fewer[question.station, 1], question.most)
        more[question.station, 0] = max(more[question.station, 0], question.most + 1)
        return _Left(self.flights, fewer), _Left(self.flights, more)


def _open_cases(
    case: Case, left: _Left, value: float, bound: float, where: str
) -> Iterator[tuple[str, float]]:
    """Yield the cases that do not prove ``bound``, and what they prove.

    Parameters
    ----------
    value
        What is proved already.
    where
        The answers that lead to the case.
    """
    for given in case.rounds:
        if left.impossible():
            return
        proved, left = left.after(given, bound)
        value = max(value, proved)
        if value >= bound * (1 - TOLERANCE):
            return
    if left.impossible():
        return
    if case.question is None or case.yes is None or case.no is None:
        yield where, value
        return
    yes, no = left.parted(case.question)
    yield from _open_cases(case.yes, yes, value, bound, f"{where}, yes")
    yield from _open_cases(case.no, no, value, bound, f"{where}, no")
