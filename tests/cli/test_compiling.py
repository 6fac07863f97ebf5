"""What is said before the exact method is compiled."""

import pytest
from rich.console import Console

from windopt.cli import compiling
from windopt.solving import readiness


@pytest.fixture
def told(monkeypatch):
    """Return what is noted for a method on a kind of terminal."""

    def told(method, *, terminal, compiled):
        sentences = []
        monkeypatch.setattr(compiling, "err", Console(stderr=True, force_terminal=terminal))
        monkeypatch.setattr(compiling, "note", sentences.extend)
        monkeypatch.setattr(readiness, "is_compiled", lambda: compiled)
        compiling.tell_of_compiling(method)
        return sentences

    return told


def test_whoever_waits_for_compiling_is_told_so(told):
    assert told("exact", terminal=True, compiled=False) == [compiling.SENTENCE]


@pytest.mark.parametrize(
    ("method", "terminal", "compiled"),
    [("exact", False, False), ("exact", True, True), ("baseline", True, False)],
)
def test_nobody_else_is(told, method, terminal, compiled):
    assert told(method, terminal=terminal, compiled=compiled) == []
