"""Finding a benchmark by name."""

import sys

import pytest

from benchmarks.__main__ import main
from benchmarks.registry import problem
from windopt.errors import MissingExtra


def without(package: str, patch: pytest.MonkeyPatch) -> None:
    """Let Python not find ``package``, nor any benchmark that was imported with it."""
    patch.setitem(sys.modules, package, None)
    for name in list(sys.modules):
        if name.startswith(("benchmarks.forecast", "windopt.forecasting.training")):
            patch.delitem(sys.modules, name)


def test_a_benchmark_whose_package_is_missing_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    without("torch", monkeypatch)
    with pytest.raises(MissingExtra, match=r"'forecast' \(torch\).*windopt\[bench\]"):
        problem("forecast")
    with pytest.raises(SystemExit, match="bench"):
        main(["run", "forecast", "--out", "nowhere"])


@pytest.mark.parametrize("name", ["routing", "yaw", "edge"])
def test_what_needs_no_training_is_there_without_torch(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    without("torch", monkeypatch)
    assert problem(name).instances("small")
