"""How much plans inspect, and how much plans can."""

from dataclasses import replace

import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.planning.coverage import coverage
from windopt.planning.inspection import plan_inspection
from windopt.planning.worth import unit_of_priority, worth_of_priorities

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
    assert covered.most == covered.inspected
    assert result.objective - covered.forgone == pytest.approx(plan.duration)
    assert not covered.weighted


@pytest.mark.parametrize(("bound", "fewer"), [(0.5, 0), (1.5, 1), (float("-inf"), 0)])
def test_a_bound_rules_turbines_out(bound, fewer):
    covered = coverage(replace(planned(), bound=bound * UNIT))
    assert covered.most == covered.of - fewer


def test_priorities_count():
    covered = coverage(planned(worth=worth_of_priorities(ROW, FLEET, {"T1": 5})))
    assert covered.weighted
    assert covered.of - covered.inspected < 5 < covered.inspected


@pytest.mark.parametrize("worth", [900.0, 0.0])
def test_seconds_are_no_priorities(worth):
    assert coverage(planned(worth=worth)) is None
    assert (
        coverage(plan_inspection(ROW, Fleet((replace(FLEET.stations[0], max_flights=None),)), WIND))
        is None
    )
