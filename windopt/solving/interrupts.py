"""Ctrl-C put off: what must not be broken off ends first, and then the user is heard."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event, current_thread, main_thread


@contextmanager
def ctrl_c_sets(stop: Event) -> Iterator[None]:
    """Let Ctrl-C set ``stop`` where it would raise, so that it cannot come at a wrong moment."""
    raises = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if not raises or current_thread() is not main_thread():
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: stop.set())
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Put Ctrl-C off to the end: raised as a compiled loop returns, it would end the process.

    If the block raises, that exception counts and Ctrl-C is forgotten.
    """
    stop = Event()
    with ctrl_c_sets(stop):
        yield
    if stop.is_set():
        raise KeyboardInterrupt
