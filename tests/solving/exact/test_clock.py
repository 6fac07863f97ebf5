"""The clock: work in threads, and an end to it."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from time import sleep

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

    with Clock(60.0) as clock:
        clock.leaders = ThreadPoolExecutor(2)
        with pytest.raises(ValueError, match="a mistake"):
            clock.side_by_side(work, [False, True])
        with pytest.raises(OutOfTime):
            clock.check()


def test_a_mistake_is_not_taken_for_the_end_of_time():
    both_begun = Barrier(2)

    def work(fails):
        both_begun.wait(60.0)
        if fails:
            sleep(0.2)  # the other is the first to end
            raise ValueError("a mistake")
        clock.halt()
        clock.check()

    with Clock(60.0) as clock:
        clock.leaders = ThreadPoolExecutor(2)
        with pytest.raises(ValueError, match="a mistake"):
            clock.side_by_side(work, [False, True])
