"""The clock: work in threads, and an end to it."""

import pytest

from windopt.solving.exact.clock import Clock, OutOfTime


def test_functions_side_by_side_may_share_out_work_of_their_own():
    with Clock(60.0) as clock:
        each = range(4 * clock.threads)

        def total(number):
            return sum(clock.map(lambda other: number * other, each))

        assert clock.side_by_side(total, each) == [number * sum(each) for number in each]


def test_one_that_fails_stops_those_beside_it():
    def work(fails):
        if fails:
            raise ValueError("a mistake")
        while True:
            clock.check()

    with Clock(60.0) as clock, pytest.raises(ValueError, match="a mistake"):
        clock.side_by_side(work, [False, True])
    with pytest.raises(OutOfTime):
        clock.check()
