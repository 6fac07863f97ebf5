"""That one call compiles what searches call, and that it is known when that was done."""

import subprocess
import sys

import pytest

from windopt.solving import readiness
from windopt.solving.readiness import compile_loops, is_compiled, make_ready


@pytest.fixture
def stamp(monkeypatch, tmp_path):
    """Keep the stamp where nobody else looks."""
    monkeypatch.setattr(readiness, "_stamp", lambda: tmp_path / "stamp")
    make_ready.cache_clear()
    yield tmp_path / "stamp"
    make_ready.cache_clear()


@pytest.fixture
def compiled(monkeypatch):
    """Return how often the loops were compiled."""
    times = []
    monkeypatch.setattr(readiness, "compile_loops", lambda: times.append(1))
    return times


def test_loops_are_compiled_once(stamp, compiled):
    assert not is_compiled()
    make_ready()
    make_ready()
    assert is_compiled()
    make_ready.cache_clear()  # as in another process
    make_ready()
    assert len(compiled) == 1


@pytest.mark.parametrize("changed", ["numba.__version__", "machine"])
def test_what_compiles_matters(monkeypatch, stamp, compiled, changed):
    make_ready()
    other = "0.0" if changed.endswith("version__") else lambda: "another"
    monkeypatch.setattr(f"windopt.solving.readiness.{changed}", other)
    assert not is_compiled()


def test_so_do_the_sources(monkeypatch, stamp, compiled, tmp_path):
    folder = tmp_path / "exact"
    folder.mkdir()
    (folder / "loop.py").write_text("one", encoding="utf-8")
    monkeypatch.setattr(readiness, "__file__", str(tmp_path / "readiness.py"))
    make_ready()
    assert is_compiled()
    (folder / "loop.py").write_text("two", encoding="utf-8")
    assert not is_compiled()


def test_where_no_stamp_can_be_kept_it_is_done_once_in_a_process(monkeypatch, tmp_path, compiled):
    monkeypatch.setattr(readiness, "_stamp", lambda: tmp_path / "nowhere" / "stamp")
    make_ready.cache_clear()
    make_ready()
    make_ready()
    assert len(compiled) == 1
    make_ready.cache_clear()


SEARCH = """
import pkgutil
from dataclasses import replace
from importlib import import_module

import numpy as np

from windopt.solving import exact, readiness
from windopt.solving.column_generation import column_generation
from windopt.solving.exact import listing, tightening


def compiled():
    names = [each.name for each in pkgutil.iter_modules(exact.__path__)]
    modules = [import_module(f"{exact.__name__}.{name}") for name in names]
    known = [value for module in modules for value in vars(module).values()]
    loops = {value for value in known if hasattr(value, "signatures")}
    return {(loop.__name__, str(signature)) for loop in loops for signature in loop.signatures}


def counted(module, name):
    function = getattr(module, name)

    def count(*given, **options):
        calls[name] = calls.get(name, 0) + 1
        return function(*given, **options)

    setattr(module, name, count)


if __name__ == "__main__":
    readiness.compile_loops()
    before, calls = compiled(), {}
    for name in "violations", "violated_rows":
        counted(tightening, name)
    counted(listing, "enumerate_flights")
    farm = readiness._small_farm()
    longer = replace(farm, t_max=np.array([950.0]))
    two = {
        field: np.repeat(getattr(farm, field), 2, axis=0)
        for field in ("t", "t_max", "stations", "allowed")
    }
    few = {"prize": np.full(len(farm.turbines), 1e5), "max_flights": np.array([2.0, 2.0])}
    for instance in longer, replace(farm, **two), replace(farm, **two, **few):
        column_generation(instance, time_limit=20.0)
    assert len(calls) == 3, calls
    assert compiled() == before, compiled() - before
"""


def test_other_searches_call_no_loop_that_was_not_compiled(tmp_path):
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


def test_loops_that_take_too_long_are_left_to_the_search(monkeypatch):
    monkeypatch.setattr(readiness, "LIMIT", 0.0)
    compile_loops()
