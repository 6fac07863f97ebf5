"""What is said before the exact method is compiled."""

import pytest

from windopt.cli import compiling
from windopt.solving import readiness


@pytest.fixture
def told(monkeypatch):
    """Return what is noted for a method."""

    def told(method, *, compiled):
        sentences = []
        monkeypatch.setattr(compiling, "note", sentences.extend)
        monkeypatch.setattr(readiness, "is_compiled", lambda: compiled)
        compiling.tell_of_compiling(method)
        return sentences

    return told


def test_whoever_waits_for_compiling_is_told_so(told):
    assert told("exact", compiled=False) == [compiling.SENTENCE]


@pytest.mark.parametrize(("method", "compiled"), [("exact", True), ("baseline", False)])
def test_nobody_else_is(told, method, compiled):
    assert told(method, compiled=compiled) == []
