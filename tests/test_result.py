"""What a result says of itself."""

from dataclasses import replace

import pytest

from windopt.result import Result, Status

PROVED = Result(Status.OPTIMAL, tuple(range(1000)), objective=1000.0, bound=995.0, runtime=2.0)


def test_a_gap_is_mentioned_where_one_was_asked_for():
    assert PROVED.sentence == "Proved best."
    assert "0.5%" in replace(PROVED, asked_gap=0.005).sentence
    assert (
        replace(PROVED, status=Status.FEASIBLE, asked_gap=0.005).sentence
        == Status.FEASIBLE.sentence
    )


def test_a_result_prints_in_a_line():
    assert repr(PROVED) == (
        "<Result: optimal, tuple, objective=1000, bound=995, gap=0.005, runtime=2>"
    )
    assert "no solution" in repr(PROVED.carrying(None))


def test_what_was_not_found_is_told():
    with pytest.raises(ValueError, match="no solution keeps every constraint"):
        Result(Status.INFEASIBLE, None, 0.0, 0.0, 0.0).found()
