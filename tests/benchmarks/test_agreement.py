"""Column generation and the flow of flight time on farms too large to enumerate."""

import pytest

from benchmarks.agreement import random_case, verdicts


def test_cases_are_drawn_by_their_seed():
    assert random_case(3) == random_case(3) != random_case(4)


@pytest.mark.slow
def test_exact_and_time_flow_never_contradict_each_other():
    found = [verdict for _, verdict in verdicts((0, 1, 92), time_limit=20.0)]
    assert "same optimum" in found
    assert "contradiction" not in found
