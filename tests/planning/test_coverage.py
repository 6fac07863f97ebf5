"""How much plans inspect, and how much plans can."""

from dataclasses import replace

import numpy as np
import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.planning.coverage import coverage
from windopt.planning.inspection import plan_inspection
from windopt.planning.worth import unit_of_priority, worth_of_priorities
from windopt.result import Status

WIND = Wind.from_met(8.0, 90.0)
ROW = Farm("row", tuple(Turbine(f"T{i}", 1000.0 * i, 0.0) for i in range(6)))
FLEET = Fleet((Station("west", 0.0, 500.0, Uav(t_max=700.0), max_flights=1),))
UNIT = unit_of_priority(FLEET, len(ROW))


def planned(**options):
    return plan_inspection(ROW, FLEET, WIND, dwell=60.0, **options)


def test_a_proved_plan_inspects_the_most():
    result = planned()
    plan, covered = result.found(), coverage(result)
    assert covered.of == 6 - len(plan.unreachable) > covered.inspected
    assert covered.inspected == sum(len(flight.turbines) for flight in plan.flights)
    assert covered.most == covered.priority == covered.inspected
    assert result.objective - covered.forgone == pytest.approx(plan.duration)
    assert not covered.weighted


@pytest.mark.parametrize(("bound", "fewer"), [(0.5, 0), (1.5, 1), (float("-inf"), 0)])
def test_a_bound_rules_turbines_out(bound, fewer):
    covered = coverage(replace(planned(), bound=bound * UNIT))
    assert covered.most == covered.total - fewer


def test_priorities_count():
    result = planned(worth=worth_of_priorities(ROW, FLEET, {"T1": 5}))
    plan, covered = result.found(), coverage(result)
    inspected = [name for flight in plan.flights for name in flight.turbines]
    assert covered.weighted
    assert covered.total == covered.of + 4
    assert covered.inspected == len(inspected)
    assert covered.priority == sum(5 if name == "T1" else 1 for name in inspected)
    assert coverage(planned(worth=2.0 * UNIT)).weighted


@pytest.mark.parametrize("part", [0.0, 0.3, 0.9, 0.999, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_no_bound_rules_out_what_the_best_plan_inspects(seed, part):
    priority = np.random.default_rng(seed).integers(1, 6, len(ROW)).tolist()
    worth = worth_of_priorities(ROW, FLEET, dict(zip(ROW.names, priority, strict=True)))
    best = planned(worth=worth)
    assert best.status is Status.OPTIMAL
    covered = coverage(replace(best, bound=part * best.bound))
    assert covered.most >= covered.priority
    assert covered.most == covered.priority or part < 1.0


@pytest.mark.parametrize("worth", [900.0, 0.0])
def test_seconds_are_no_priorities(worth):
    assert coverage(planned(worth=worth)) is None
    assert (
        coverage(plan_inspection(ROW, Fleet((replace(FLEET.stations[0], max_flights=None),)), WIND))
        is None
    )
