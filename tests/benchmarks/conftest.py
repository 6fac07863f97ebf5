"""Methods that go wrong, as a researcher's file beside her run."""

import pytest

METHODS = """
import os
from time import sleep

from formulations.time_flow import time_flow


def few_flights(t, t_max, *, allowed=None):
    program = time_flow(t, t_max, allowed=allowed)
    program.model.addConstr(program.x[:, 0, 1:].sum() <= 4)
    return program


def crashes(instance, *, time_limit, seed):
    os.write(2, b"out of luck")
    os._exit(3)


def hangs(instance, *, time_limit, seed):
    sleep(600)


def raises(instance, *, time_limit, seed):
    raise RuntimeError("out of luck")
"""


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """Go to a folder with a module ``mine`` of methods."""
    (tmp_path / "mine.py").write_text(METHODS, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=":")
    return tmp_path
