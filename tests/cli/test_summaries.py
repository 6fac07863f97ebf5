"""What a person is told."""

from dataclasses import replace
from math import radians

import pytest

from windopt.cli import summaries
from windopt.cli.summaries import facing, show_inspection
from windopt.cli.terminal import left_out, percent, seconds
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.plan import LeftOut, Unreachable
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection
from windopt.planning.worth import unit_of_priority, worth_of_priorities
from windopt.planning.yaw import plan_yaw
from windopt.result import Status

FARM = Farm("Row", (Turbine("A", 0.0, 0.0), Turbine("B", 900.0, 0.0)))


@pytest.mark.parametrize(("wind", "told"), [(100.0, "95.0 to 105.0"), (2.0, "357.0 to 7.0")])
def test_nacelles_are_told_clockwise(wind, told):
    plan = plan_yaw(FARM, Wind.from_met(8.0, wind), method="algorithm-1").found()
    turned = tuple(
        replace(point, nacelle=radians((wind - angle) % 360.0), misalignment=radians(angle))
        for point, angle in zip(plan.set_points, (-5.0, 5.0), strict=True)
    )
    assert facing(plan) == f"{wind:.1f}"
    assert facing(replace(plan, set_points=turned)) == told


WIND = Wind.from_met(8.0, 90.0)
LONG = Farm("Long", tuple(Turbine(f"T{i}", 1000.0 * i, 0.0) for i in range(6)))
SOUTH = Station("South", 0.0, 500.0, Uav(t_max=900.0))
FEW = Fleet((replace(SOUTH, max_flights=1),))


@pytest.fixture
def told(monkeypatch):
    """Return a function that returns the sentences about a result."""
    sentences = []
    monkeypatch.setattr(summaries, "say", sentences.append)

    def tell(result):
        sentences.clear()
        show_inspection(result)
        return sentences

    return tell


def inspected(fleet=FEW, **options):
    return plan_inspection(LONG, fleet, WIND, dwell=60.0, **options)


def test_it_is_told_how_many_are_inspected_and_can_be(told):
    result = inspected()
    plan, unit = result.found(), unit_of_priority(FEW, len(LONG))
    missed = len(plan.left_out)
    reached = 6 - len(plan.unreachable)
    inspects = f"{reached - missed} of {reached} turbines within reach are inspected"
    sentences = told(result)
    assert f"{inspects}; no plan inspects more." in sentences
    proved = f"Proved best. No plan that inspects as much takes less than {plan.duration:.2f} s"
    assert sentences[-1].startswith(proved)
    worse = replace(result, status=Status.FEASIBLE, bound=(missed - 0.5) * unit)
    sentences = told(worse)
    assert f"{inspects}; no plan inspects more than {reached - missed + 1}." in sentences
    assert "less than" not in sentences[-1]


def test_where_all_are_inspected_nothing_is_said_of_worth(told):
    sentences = told(inspected(Fleet((replace(SOUTH, max_flights=9),))))
    assert any(sentence.startswith("All ") for sentence in sentences)
    assert not any("worth" in sentence or "left out" in sentence for sentence in sentences)


def test_priorities_are_told_apart_from_numbers(told):
    priorities = worth_of_priorities(LONG, FEW, {"T1": 5})
    result = inspected(worth=priorities)
    (sentence,) = (each for each in told(result) if "turbines within reach" in each)
    assert "a sum of priorities of " in sentence
    assert sentence.endswith("; no plan reaches more.")
    enough = Fleet((replace(SOUTH, max_flights=9),))
    free = inspected(enough, worth=worth_of_priorities(LONG, enough, {"T1": 5}))
    turbines = 6 - len(free.found().unreachable)
    assert f"All {turbines} turbines within reach are inspected." in told(free)


def test_worth_in_seconds_is_told(told):
    sentences = told(inspected(worth=1.0))
    assert any("turbines left out, worth" in sentence for sentence in sentences)


def test_turbines_of_one_reason_share_a_line_and_lines_are_few(told):
    result = inspected()
    plan = result.found()
    same = tuple(LeftOut(name, "No flight is left.") for name in "XYZ")
    other = tuple(Unreachable(f"A{i}", f"It takes {i} s.") for i in range(8))
    sentences = told(
        replace(result, solution=replace(plan, left_out=same, unreachable=other, worth=None))
    )
    assert "Left out: X, Y, Z. No flight is left." in sentences
    assert sum(sentence.startswith("Unreachable") for sentence in sentences) == 6
    assert any("A5, A6, A7" in sentence for sentence in sentences)


@pytest.mark.parametrize(
    ("gap", "words"), [(0.0, "0.00%"), (-1e-12, "0.00%"), (2e-6, "<0.01%"), (0.0123, "1.23%")]
)
def test_an_open_gap_is_never_none(gap, words):
    assert percent(gap) == words


def test_progress_is_told_in_seconds_or_turbines():
    assert seconds(120.0, 100.0) == "plan 120.0 s, bound 100.0 s"
    assert left_out("turbines", 1000.0)(3200.0, 2050.0) == "turbines left out: 3, at least 2"
