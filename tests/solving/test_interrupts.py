"""Ctrl-C waits until a compiled loop has ended."""

import signal

import pytest

from windopt.solving.interrupts import uninterrupted


def test_ctrl_c_is_put_off_to_the_end():
    done = []

    @uninterrupted()
    def work():
        signal.raise_signal(signal.SIGINT)
        done.append("to the end")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["to the end"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_fault_stays_what_it_is():
    with pytest.raises(ValueError, match="bad"), uninterrupted():
        raise ValueError("bad")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_fault_counts_more_than_ctrl_c():
    @uninterrupted()
    def work():
        signal.raise_signal(signal.SIGINT)
        raise ValueError("bad")

    with pytest.raises(ValueError, match="bad"):
        work()


def test_without_ctrl_c_nothing_happens():
    @uninterrupted()
    def doubled(number):
        return 2 * number

    assert [doubled(2), doubled(3)] == [4, 6]
