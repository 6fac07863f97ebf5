"""A run in a thread of its own: no exception and no Ctrl-C leaves it behind."""

import os
import signal
import sys
import threading
from time import perf_counter

import highspy
import numpy as np
import pytest

from windopt.solving.watched import run

PRESS = pytest.mark.skipif(sys.platform == "win32", reason="os.kill ends a process on Windows")


def press_ctrl_c():
    os.kill(os.getpid(), signal.SIGINT)


@pytest.fixture
def before():
    """Threads that run already: a pool that another test has left, for one."""
    return set(threading.enumerate())


@pytest.fixture
def market():
    """Split of 60 items over 5 markets: HiGHS finds plans at once and proves for hours."""
    rng = np.random.default_rng(0)
    model = highspy.Highs()
    model.silent()
    model.setOptionValue("threads", 1)
    model.setOptionValue("time_limit", 60.0)
    x = model.addBinaries(60)
    short = model.addVariables(5)
    for row, slack in zip(rng.integers(1, 100, (5, 60)), short, strict=True):
        model.addConstr((row * x).sum() + slack >= row.sum() // 2 + 0.5)
        model.addConstr((row * x).sum() - slack <= row.sum() // 2 + 0.5)
    model.setObjective(short.sum(), highspy.ObjSense.kMinimize)
    return model


def ended_and_can_run_again(model, before):
    for thread in set(threading.enumerate()) - before:
        thread.join(1.0)
    assert set(threading.enumerate()) <= before
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    model.setOptionValue("time_limit", 0.1 + model.getRunTime())
    return run(model, lambda _: None) is False


def test_what_the_listener_raises_ends_the_run_and_reaches_the_caller(market, before):
    def fail(news):
        raise ZeroDivisionError

    began = perf_counter()
    with pytest.raises(ZeroDivisionError):
        run(market, fail)
    assert perf_counter() - began < 5.0
    assert ended_and_can_run_again(market, before)


@PRESS
def test_ctrl_c_ends_the_run(market, before):
    threading.Timer(0.5, press_ctrl_c).start()
    assert run(market, lambda _: None)
    assert ended_and_can_run_again(market, before)


def test_ctrl_c_may_be_pressed_again_and_again(market, before):
    pressed = []

    def press(news):
        signal.raise_signal(signal.SIGINT)
        pressed.append(news)

    assert run(market, press)
    assert len(pressed) > 1
    assert ended_and_can_run_again(market, before)


@PRESS
def test_ctrl_c_that_a_caller_handles_itself_ends_the_run_too(market):
    def handler(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGINT, handler)
    try:
        threading.Timer(0.5, press_ctrl_c).start()
        assert run(market, lambda _: None)
        assert signal.getsignal(signal.SIGINT) is handler
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def test_a_listener_may_stop_the_run_as_ctrl_c_does(market, before):
    def stop(news):
        raise KeyboardInterrupt

    assert run(market, stop)
    assert ended_and_can_run_again(market, before)


def test_a_run_beside_the_main_thread_ends_by_its_limit(market):
    market.setOptionValue("time_limit", 0.2)
    answers = []
    thread = threading.Thread(target=lambda: answers.append(run(market, lambda _: None)))
    thread.start()
    thread.join()
    assert answers == [False]


def test_what_highs_raises_reaches_the_caller(market, before, monkeypatch):
    def fail():
        raise MemoryError

    class Failing:
        def __getattr__(self, name):
            return fail if name == "run" else getattr(market, name)

    with pytest.raises(MemoryError):
        run(Failing(), lambda _: None)
    assert ended_and_can_run_again(market, before)
