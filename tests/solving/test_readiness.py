"""That one call compiles what searches call, and that it is known when that was done."""

import subprocess
import sys
from pathlib import Path

import pytest

from windopt.solving import readiness
from windopt.solving.readiness import compile_loops, is_compiled


def test_loops_are_known_to_be_compiled():
    compile_loops()
    assert is_compiled()


@pytest.mark.parametrize("loop", readiness.LOOPS, ids=lambda loop: loop.__name__)
def test_a_loop_that_is_older_than_its_source_is_not(monkeypatch, tmp_path, loop):
    compile_loops()
    folder = Path(loop.stats.cache_path)
    newest = max(each.stat().st_mtime for each in folder.glob("*.nbi"))

    class Edited(type(tmp_path)):
        def stat(self, **options):
            facts = super().stat(**options)
            return type("Facts", (), {"st_mtime": newest + 1.0}) if self.suffix == ".py" else facts

    monkeypatch.setattr(readiness, "Path", Edited)
    assert not is_compiled()


SEARCH = """
import pkgutil
from importlib import import_module

import numpy as np

from windopt.solving import exact, readiness
from windopt.solving.column_generation import column_generation


def compiled():
    names = [each.name for each in pkgutil.iter_modules(exact.__path__)]
    modules = [import_module(f"{exact.__name__}.{name}") for name in names]
    known = [value for module in modules for value in vars(module).values()]
    loops = {value for value in known if hasattr(value, "signatures")}
    return {(loop.__name__, str(signature)) for loop in loops for signature in loop.signatures}


if __name__ == "__main__":
    readiness.compile_loops()
    before = compiled()
    farm = readiness._jittered_grid()
    farm.t_max[:] = 900.0
    column_generation(farm, time_limit=3.0)
    assert compiled() == before, compiled() - before
"""


def test_a_longer_search_calls_no_loop_that_was_not_compiled(tmp_path):
    (tmp_path / "search.py").write_text(SEARCH, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, tmp_path / "search.py"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_who_does_not_want_to_wait_is_heard(monkeypatch):
    def interrupted(*_, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("windopt.solving.column_generation._plan", interrupted)
    with pytest.raises(KeyboardInterrupt):
        compile_loops()
