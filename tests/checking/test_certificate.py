"""Certificates: true ones pass, and no forgery proves a bound that does not hold."""

from dataclasses import replace

import numpy as np
import pytest

import windopt
from windopt.checking import tails
from windopt.checking.certificate import check_certificate
from windopt.domain.certificate import Case, Round, Sent, Together
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import Unreachable
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.certification import certify
from windopt.planning.inspection import plan_inspection
from windopt.result import Status
from windopt.solving import certification
from windopt.solving.exact import cases
from windopt.solving.exact.clock import OutOfTime
from windopt.solving.exact.pricing import LabelsOverflow
from windopt.solving.exact.relaxation import Relaxation


def random_result(seed, most=9):
    """Plan a random farm from random stations in a random wind, and prove the plan optimal."""
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(2, most + 1)), int(rng.integers(1, 4))
    turbines = tuple(Turbine(f"T{i}", *rng.uniform(0, 5000, 2)) for i in range(n))
    uavs = [Uav(f"U{d}", rng.uniform(13, 20), rng.uniform(700, 1500)) for d in range(k)]
    fleet = Fleet(tuple(Station(f"S{d}", *rng.uniform(0, 5000, 2), uavs[d]) for d in range(k)))
    wind = Wind.from_met(rng.uniform(0, 12), rng.uniform(0, 360))
    dwell = (rng.choice([0.0, 1.0]) * rng.uniform(0, 120, n)).tolist()
    farm = Farm("random", turbines)
    limit = 300.0  # the first search of all compiles its loops
    return plan_inspection(farm, fleet, wind, method="exact", dwell=dwell, time_limit=limit)


@pytest.mark.parametrize("seed", range(40))
def test_the_certificate_of_an_optimum_passes(seed):
    result = random_result(seed)
    assert result.status is Status.OPTIMAL
    certificate = certify(result)
    assert certificate.reason == ""
    report = windopt.check(result, certificate)
    assert report.passed, report
    assert certificate.proof.bound == pytest.approx(result.bound, rel=1e-7)
    assert report.proved


def test_only_results_have_certificates_and_only_plans_are_checked():
    result = random_result(3)
    with pytest.raises(InvalidInput, match="result to be a Result"):
        certify(result.solution)
    for other in (None, result.solution.farm):
        with pytest.raises(InvalidInput, match="plan to be a YawPlan"):
            windopt.check(other)


@pytest.mark.parametrize("ended", [OutOfTime, LabelsOverflow, KeyboardInterrupt])
@pytest.mark.parametrize("after", [0, 1])
def test_what_is_proved_before_the_end_is_kept(monkeypatch, ended, after):
    result = random_result(3)

    def end(*_):
        raise ended

    ends = Relaxation.grow_neighbourhoods if after else Relaxation.begin
    monkeypatch.setattr(Relaxation, ends.__name__, end)
    certificate = certify(result)
    proved = certificate.proof.bound
    assert 0.4 * result.bound < proved < result.bound
    assert ("user" in certificate.reason) == (ended is KeyboardInterrupt)
    report = check_certificate(result.solution, proved, certificate)
    assert report.passed, report
    assert not check_certificate(result.solution, result.bound, certificate).passed


def test_where_the_whole_gap_takes_too_long_a_part_is_proved(monkeypatch):
    result, calls = random_result(20, most=16), []
    monkeypatch.setattr(cases, "LEAST_VIOLATION", 10.0)

    def slow_at_first(*given):
        calls.append(given)
        if len(calls) == 1:
            raise OutOfTime
        return cases.prove(*given)

    monkeypatch.setattr(certification, "prove", slow_at_first)
    certificate = certify(result)
    assert certificate.proof.bound < result.bound
    assert certificate.reason
    assert check_certificate(result.solution, certificate.proof.bound, certificate).passed


@pytest.mark.parametrize("seed", range(40, 60))
def test_a_bound_above_the_optimum_is_never_proved(seed):
    result, rng = random_result(seed), np.random.default_rng(seed)
    certificate = certify(result)
    for _ in range(10):
        bound = result.objective * (1 + 10 ** rng.uniform(-6, -2))
        forged = inflated(certificate, bound, rng)
        assert not check_certificate(result.solution, bound, forged).passed


def inflated(certificate, bound, rng):
    """Return a certificate that claims ``bound``, with prices raised at random."""

    def raised(prices):
        return prices + rng.choice([0.0, 1.0, 30.0], p=[0.8, 0.1, 0.1], size=len(prices))

    def all_raised(case):
        rounds = tuple(replace(each, prices=raised(each.prices)) for each in case.rounds)
        if case.question is None:
            return Case(rounds)
        return Case(rounds, case.question, all_raised(case.yes), all_raised(case.no))

    proof = certificate.proof
    return replace(
        certificate,
        proof=replace(proof, bound=bound, prices=raised(proof.prices), case=all_raised(proof.case)),
    )


@pytest.mark.parametrize("seed", range(20))
def test_plans_that_leave_turbines_out_are_proved_too(seed):
    whole, rng = random_result(seed, most=7).found(), np.random.default_rng(seed)
    stations = (replace(whole.fleet.stations[0], max_flights=1), *whole.fleet.stations[1:])
    worth = rng.uniform(0, 800, len(whole.farm)).tolist() if seed % 2 else None
    names = whole.fleet.names
    assignment = {
        name: (names[i % len(names)], names[0]) for i, name in enumerate(whole.farm.names)
    }
    result = plan_inspection(
        whole.farm, Fleet(stations), whole.wind, method="exact", dwell=whole.dwell, worth=worth,
        assignment=assignment if seed % 3 else None,
    )  # fmt: skip
    certificate = certify(result)
    assert windopt.check(result, certificate).passed
    bound = result.objective * (1 + 1e-4)
    forged = inflated(certificate, bound, rng)
    assert not check_certificate(result.solution, bound, forged).passed


@pytest.fixture(scope="module")
def branched():
    """Return a plan and its certificate, without subset rows so that cases are needed."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cases, "LEAST_VIOLATION", 10.0)
        result = random_result(20, most=16)
        return result, certify(result)


def edited(case, path, edit):
    """Return a proof's case with the one that ``path``, of yes and no, leads to edited."""
    if not path:
        return edit(case)
    return replace(case, **{path[0]: edited(getattr(case, path[0]), path[1:], edit)})


def paths(case, path=()):
    """Return the way to each case."""
    yield path, case
    for answer in ("yes", "no") if case.question else ():
        yield from paths(getattr(case, answer), (*path, answer))


def faults(result, certificate, **changes):
    """Return what is wrong with a certificate whose proof is changed."""
    changed = replace(certificate, proof=replace(certificate.proof, **changes))
    return check_certificate(result.solution, result.bound, changed).violations


def test_a_proof_may_ask_both_questions(branched):
    result, certificate = branched
    asked = {type(case.question) for case in certificate.proof.case.all()}
    assert asked == {Together, Sent, type(None)}
    assert windopt.check(result, certificate).passed


def test_no_case_can_be_left_out(branched):
    result, certificate = branched
    for path, case in paths(certificate.proof.case):
        if case.question:
            alone = edited(certificate.proof.case, path, lambda case: Case(case.rounds))
            assert faults(result, certificate, case=alone), path


def test_no_last_round_can_be_left_out(branched):
    result, certificate = branched
    for path, case in paths(certificate.proof.case):
        if case.rounds and not case.question:
            without = edited(certificate.proof.case, path, lambda case: Case(case.rounds[:-1]))
            assert faults(result, certificate, case=without), path


def test_the_answers_cannot_be_exchanged(branched):
    result, certificate = branched
    root = certificate.proof.case
    assert faults(result, certificate, case=replace(root, yes=root.no, no=root.yes))


def test_no_first_price_can_be_raised(branched):
    result, certificate = branched
    prices = certificate.proof.prices
    for raised in prices + np.eye(len(prices)):
        (fault,) = faults(result, certificate, prices=raised)
        assert "reduced cost" in fault


def test_no_price_of_a_last_round_can_be_raised(branched):
    result, certificate = branched
    proof = certificate.proof
    path, case = next(
        (path, case) for path, case in paths(proof.case) if case.rounds and not case.question
    )
    last = case.rounds[-1]
    for prices in last.prices + 1e4 * np.eye(len(last.prices)):
        dearer = Case((*case.rounds[:-1], replace(last, prices=prices)))
        changed = edited(proof.case, path, lambda _, dearer=dearer: dearer)
        assert faults(result, certificate, case=changed)


def test_no_toll_can_be_charged_for_flights_of_any_number(branched):
    result, certificate = branched
    root = certificate.proof.case
    for toll in -50.0 * np.eye(len(certificate.stations) + 1):
        paid = (*root.rounds[:-1], replace(root.rounds[-1], tolls=toll))
        alone = Case((*paid, *(5 * paid[-1:])))
        assert faults(result, certificate, case=alone)


def test_no_bound_above_the_certified_one_can_be_claimed(branched):
    result, certificate = branched
    weaker = replace(certificate, proof=replace(certificate.proof, bound=0.99 * result.bound))
    (violation,) = check_certificate(result.solution, result.bound, weaker).violations
    assert "is certified" in violation
    assert check_certificate(result.solution, 0.99 * result.bound, weaker).passed


def test_a_certificate_is_about_one_farm_one_fleet_and_one_wind():
    result = random_result(7, most=6)
    certificate, plan = certify(result), result.solution
    calm = replace(plan, wind=Wind(0.0, 0.0))
    nearer = Turbine(plan.farm.names[0], plan.fleet.stations[0].x, plan.fleet.stations[0].y)
    moved = replace(plan, farm=replace(plan.farm, turbines=(nearer, *plan.farm.turbines[1:])))
    fleet = Fleet(tuple(replace(each, uav=Uav(airspeed=25.0)) for each in plan.fleet.stations))
    for other in calm, moved, replace(plan, fleet=fleet):
        assert check_certificate(other, result.bound, certificate).violations
    fewer = replace(plan, unreachable=(Unreachable("T0", "too far"),))
    (violation,) = check_certificate(fewer, result.bound, certificate).violations
    assert violation == "it is not about the turbines within reach"
    renamed = Fleet(tuple(replace(each, name=f"{each.name}!") for each in plan.fleet.stations))
    (violation,) = check_certificate(replace(plan, fleet=renamed), 0.0, certificate).violations
    assert violation == "it is not about the stations of the plan"


@pytest.mark.parametrize("huge", [1e308, 1e30, 1e15])
def test_no_rounding_of_huge_prices_proves_anything(branched, huge):
    result, certificate = branched
    n, k = len(certificate.turbines), len(certificate.stations)
    none = np.zeros((0, 3), np.int64), np.zeros(0)
    for prices in np.full(n, huge), huge * (-1.0) ** np.arange(n):
        forged = Case((Round(prices, np.zeros(k + 1), *none),))
        (fault,) = faults(result, certificate, case=forged)
        assert "out of scale" in fault


def test_a_certificate_is_not_looked_at_before_the_plan_passes(branched):
    result, certificate = branched
    report = windopt.check(replace(result, objective=1.0), certificate)
    assert report.violations
    assert report.unverified == ("certificate: it is not looked at before the plan passes",)


def test_wrong_neighbours_only_take_longer(branched):
    result, certificate = branched
    nobody = ((),) * len(certificate.turbines)
    assert not faults(result, certificate, neighbours=nobody)


def test_what_is_not_feasible_to_verify_is_neither_passed_nor_violated(monkeypatch, branched):
    monkeypatch.setattr(tails, "MOST", 20)
    report = windopt.check(*branched)
    assert not report.violations
    assert not report.passed
    assert report.unverified
    assert not report.proved


def test_a_certificate_needs_a_plan_with_a_claim(branched):
    result, certificate = branched
    with pytest.raises(InvalidInput, match="the bound on them"):
        windopt.check(result.solution, certificate)


def test_nothing_to_inspect_is_proved_to_take_no_time():
    farm = Farm("far", (Turbine("T0", 1e6, 0.0),))
    fleet = Fleet((Station("S0", 0.0, 0.0),))
    result = plan_inspection(farm, fleet, Wind(0.0, 0.0), method="exact")
    certificate = certify(result)
    assert certificate == certificate
    assert windopt.check(result, certificate).passed


def test_a_heuristics_bound_can_be_certified():
    site = random_result(3).found()
    result = plan_inspection(site.farm, site.fleet, site.wind, method="algorithm-2")
    assert windopt.check(result, certify(result)).passed
