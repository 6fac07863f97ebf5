"""Whether a certificate proves its bound, by other means than those that found it.

Nothing in a certificate is taken on trust. Where a reduced cost is negative after all, the bound is
lowered by as much as that can matter: a plan has no more flights than turbines.
"""

from collections.abc import Iterator
from math import inf

import numpy as np

from windopt.checking.cheap_flights import cheap_flights
from windopt.checking.remaining import Remaining, Terms
from windopt.checking.report import Report
from windopt.checking.tails import TooMany
from windopt.checking.times import times_of_legs
from windopt.domain.certificate import Case, Certificate, Round
from windopt.domain.plan import InspectionPlan

TOLERANCE = 1e-7
"""Part of the bound that a proof may lack."""
MARGIN = 1e-8
"""Part of the bound that gaps are widened by before flights are dropped: far more than rounding."""
LARGEST = 1e3
"""Bounds that a price may be: rounding is then a 1e-11th of the bound, and far from the margin."""
OVERSTATED = 1e-6
"""Relative; what a bound may exceed its proof by, as it may exceed an objective."""


def check_certificate(plan: InspectionPlan, bound: float, certificate: Certificate) -> Report:
    """Verify that no plan for the farm, fleet and wind of ``plan`` costs less than ``bound`` [s].

    Plans are those that visit the turbines within reach, or forgo their worth where ``plan`` may.
    """
    refused = (*_strangers(plan, certificate), *_out_of_scale(certificate))
    if refused:
        return Report(refused)
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
    beyond = {unreachable.turbine for unreachable in plan.unreachable}
    if sorted(certificate.turbines) != sorted(set(plan.farm.names) - beyond):
        yield "it is not about the turbines within reach"
    if certificate.stations != plan.fleet.names:
        yield "it is not about the stations of the plan"


def _out_of_scale(certificate: Certificate) -> Iterator[str]:
    """Numbers so large that their rounding might matter."""
    proof = certificate.proof
    numbers = [proof.prices, proof.tolls]
    for case in proof.case.all():
        for each in case.rounds:
            numbers += [each.prices, each.tolls, each.penalties]
    largest = max(float(np.abs(each).max(initial=0.0)) for each in numbers)
    if largest > LARGEST * proof.bound:
        yield f"it has a price of {largest:.6g} s, which is out of scale"


def _faults(plan: InspectionPlan, certificate: Certificate) -> tuple[list[str], str]:
    """Return what the proof lacks, a sentence each, and the proof in a sentence."""
    proof, n = certificate.proof, len(certificate.turbines)
    terms = Terms.of(plan, certificate.turbines)
    first = Round(proof.prices, proof.tolls, np.zeros((0, 3), np.int64), np.zeros(0))
    value = terms.earned(first)
    if value == -inf:
        return ["at the first prices a toll is refunded for flights of any number"], ""
    limit = max(0.0, proof.bound - value) + MARGIN * proof.bound
    limits = limit + proof.tolls[:-1] + proof.tolls[-1]
    times = times_of_legs(plan, certificate.turbines)
    flights = cheap_flights(times, proof.prices, proof.neighbours, limits, apart=terms.limited)
    least = flights.reduced_costs(first).min(initial=0.0)
    if n * least < -MARGIN * proof.bound:
        return [f"at the first prices a flight has the reduced cost {least:.6g} s"], ""
    value, left = value + n * least, Remaining(flights, terms)
    faults = []
    if value < proof.bound * (1 - TOLERANCE):
        faults = [
            f"its {where} proves {proved:.9g} s only"
            for where, proved in _open_cases(proof.case, left, value, proof.bound, "case")
        ]
    cases = list(proof.case.all())
    rounds = 1 + sum(len(case.rounds) for case in cases)
    told = (
        f"no plan costs less than {proof.bound:.2f} s: prices leave {len(left.flights)} flights "
        f"of all that there are; rounds {rounds}, cases {len(cases)}"
    )
    return faults, told


def _open_cases(
    case: Case, left: Remaining, value: float, bound: float, where: str
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
        proved, left = left.after(given, bound, MARGIN * bound)
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
