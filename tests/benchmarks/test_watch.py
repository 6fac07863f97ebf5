"""A case that crashes or hangs fails, and the next one runs."""

import pytest

from benchmarks.case import Case
from benchmarks.watch import Watch

INSTANCE = "grid6-w10-090-d000"


def case(method, time_limit=1.0):
    return Case("routing", INSTANCE, method, time_limit)


@pytest.fixture
def watch(mine):
    watch = Watch(grace=60.0)
    yield watch
    watch.close()


def test_a_crash_a_fault_and_a_mistake_cost_one_case_each(watch):
    assert watch.run(case("mine:crashes")) == {"status": "failed", "reason": "crashed: out of luck"}
    assert watch.run(case("mine:raises"))["reason"] == "RuntimeError: out of luck"
    assert "to be one of" in watch.run(case("mine:absent"))["reason"]
    answer = watch.run(case("algorithm-2"))
    assert (answer["status"], answer["unreachable"]) == ("feasible", 0)


def test_a_case_that_hangs_is_killed_after_its_limit(mine):
    watch = Watch(grace=0.0)
    answer = watch.run(case("mine:hangs", time_limit=0.5))
    assert answer == {"status": "failed", "reason": "hung: killed after its limit"}
    watch.close()


def test_a_formulation_of_ones_own_is_measured_like_the_others(watch):
    answer = watch.run(case("mine:few_flights", time_limit=20.0))
    assert answer["status"] == "optimal"
    assert answer["bound"] == pytest.approx(answer["objective"])
    assert len(answer["flights"]) <= 4
