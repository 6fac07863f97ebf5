"""All lines together know the best plan and the best bound, whoever found them and when."""

import pytest

from benchmarks.report.best_known import (
    above,
    best_known,
    compared,
    complete,
    contradictions,
    instance,
)

FARM_B = "b-w10-090-d000"


def test_the_best_plan_and_the_best_bound_may_be_of_different_methods(lines):
    best = best_known(lines)[FARM_B, FARM_B]
    assert (best.objective, best.bound) == (240.0, 200.0)
    assert best.gap == pytest.approx(1 / 6)
    assert not best.proved
    assert above(lines[2], best) == pytest.approx(0.25)


def test_a_longer_limit_tells_how_good_a_plan_of_a_shorter_one_is(lines, line):
    longer = line("exact", 230.0, 230.0, 200.0, instance=FARM_B, status="optimal", limit=300.0)
    best = best_known([*lines, longer])[FARM_B, FARM_B]
    assert best.proved
    assert above(lines[3], best) == pytest.approx(10 / 230)


def test_a_failed_case_is_of_the_instance_of_its_name(lines):
    *_, broken = complete(lines)
    assert instance(broken) == instance(lines[0])
    assert broken["turbines"] == 20
    assert "objective" not in broken


def test_methods_are_compared_where_all_of_them_ran(lines):
    groups = compared(complete(lines))
    assert list(groups) == [("exact", "pyvrp"), ("exact", "pyvrp", "broken")]
    both, all_three = groups.values()
    assert {record["instance"][0] for record in both} == {"a", "b"}
    assert {record["instance"][0] for record in all_three} == {"a"}


def test_a_plan_below_a_proved_bound_is_told(lines, line):
    known = best_known(lines)
    assert len(contradictions(lines, known)) == 1
    lines.append(line("wrong", 99.0, None, 1.0))
    _, wrong = contradictions(lines, best_known(lines))
    assert wrong == ["a-w10-090-d000", "wrong", "99.000", "100.000"]
