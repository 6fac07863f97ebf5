"""A folder with a small farm, and the command line as a user calls it."""

import sys

import numpy as np
import pytest

from windopt.cli import main

FARM = "name,x,y\nA1,0,0\nA2,600,0\nA3,1200,0\nB1,0,700\nB2,600,700\n"
STATIONS = "id,x,y\nS1,500,300\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "farm.csv").write_text(FARM, encoding="utf-8")
    (tmp_path / "stations.csv").write_text(STATIONS, encoding="utf-8")
    time = np.datetime64("2020-01-01T00:00") + np.arange(0, 1440, 5).astype("m8[m]")
    rows = [f"{t},{8 + np.sin(i / 9):.3f},{(90 + i / 7) % 360:.2f}" for i, t in enumerate(time)]
    text = "time,speed,direction\n" + "\n".join(rows) + "\n"
    (tmp_path / "wind.csv").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def windopt(monkeypatch, capsys):
    """Run a command and return its exit code, output and complaints."""

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["windopt", *map(str, words)])
        with pytest.raises(SystemExit) as stop:
            main()
        told = capsys.readouterr()
        return stop.value.code or 0, told.out, told.err

    return run
