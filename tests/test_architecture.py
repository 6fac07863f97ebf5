"""The layers hold, their guard bites, and importing windopt stays light."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
HEAVY = "torch", "matplotlib", "cvxpy", "numba", "scipy", "highspy", "casadi"


def run(*command, cwd=ROOT):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)


def test_importing_windopt_loads_nothing_heavy():
    code = "import sys, windopt; print(*sys.modules)"
    loaded = set(run(sys.executable, "-W", "error", "-c", code).stdout.split())
    assert "windopt" in loaded
    assert not loaded & set(HEAVY)


def test_everything_that_is_promised_can_be_imported():
    code = "import windopt; [getattr(windopt, name) for name in windopt.__all__]"
    done = run(sys.executable, "-c", code)
    assert done.returncode == 0, done.stderr


@pytest.fixture
def copy(tmp_path):
    for package in "windopt", "formulations", "benchmarks":
        shutil.copytree(ROOT / package, tmp_path / package)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def lint(folder):
    return run(sys.executable, "-c", LINT, cwd=folder)


# The console script, but with the copy before the installed package on the path.
LINT = """
import sys
sys.path.insert(0, ".")
from importlinter.cli import lint_imports_command
lint_imports_command(["--no-cache"])
"""


def test_the_layers_hold(copy):
    done = lint(copy)
    assert done.returncode == 0, done.stdout


def test_a_module_in_no_layer_breaks_the_layers(copy):
    (copy / "windopt" / "physics.py").write_text('"""Shared by all."""\n', encoding="utf-8")
    assert lint(copy).returncode == 1


@pytest.mark.parametrize(
    ("module", "forbidden", "contract"),
    [
        ("formulations/time_flow.py", "windopt.domain.farm", "mathematics knows nothing"),
        ("windopt/checking/inspection.py", "formulations.wind_triangle", "the checker shares"),
        ("windopt/checking/yaw.py", "highspy", "the checker shares"),
        ("windopt/domain/farm.py", "windopt.planning.plan", "imports run down"),
        ("windopt/planning/plan.py", "windopt.io.plans", "imports run down"),
        ("windopt/solving/integer.py", "windopt.heuristics.splitting", "imports run down"),
        ("windopt/planning/yaw.py", "torch", "torch stays in training"),
        ("windopt/forecasting/lstm.py", "torch", "torch stays in training"),
        ("windopt/planning/plan.py", "matplotlib", "matplotlib in plotting"),
        ("windopt/domain/wind.py", "benchmarks.built_in_data", "nobody imports the benchmarks"),
        ("windopt/domain/wind.py", "formulations.rotor", "mathematics is reached through"),
    ],
)
def test_a_forbidden_import_breaks_its_contract(copy, module, forbidden, contract):
    path = copy / module
    path.write_text(path.read_text(encoding="utf-8") + f"\nimport {forbidden}\n", encoding="utf-8")
    done = lint(copy)
    assert done.returncode == 1
    broken = [line for line in done.stdout.splitlines() if "BROKEN" in line]
    assert any(contract in line for line in broken), done.stdout
