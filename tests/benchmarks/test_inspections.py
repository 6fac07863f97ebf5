"""An instance is its name, its fingerprint tells when it changed, and others can read it."""

import numpy as np
import pytest

from benchmarks.inspections import Inspection, square_grid
from benchmarks.routing import GRIDS, instances
from benchmarks.stations import TABLE, stations
from benchmarks.vrplib_files import export, within_reach
from benchmarks.whole_times import UNITS, whole_limits, whole_times
from windopt.errors import InvalidInput

vrplib = pytest.importorskip("vrplib")
GRID = Inspection.named("grid20-w10-090-d000")


def test_a_name_says_all_there_is_to_say():
    assert GRID.name == "grid20-w10-090-d000"
    assert (len(GRID.farm), GRID.wind.speed, GRID.dwell) == (20, 10.0, 0)
    with pytest.raises(InvalidInput, match="instance"):
        Inspection.named("grid20")


def test_the_fingerprint_changes_with_the_wind_and_the_dwell():
    names = "grid20-w10-090-d000", "grid20-w10-090-d060", "grid20-w10-135-d000"
    assert len({Inspection.named(name).hash for name in names}) == 3


def test_every_set_is_of_farms_whose_stations_are_kept():
    kept = TABLE.read_text(encoding="utf-8")
    for chosen in "small", "medium", "full":
        for name in instances(chosen):
            one = Inspection.named(name)
            assert f"\n{one.handle},{one.dwell}," in kept, name
    assert len({Inspection.named(name).handle for name in instances("small")}) >= 20
    assert len({Inspection.named(name).handle for name in instances("medium")}) >= 60


def test_stations_that_are_kept_reach_every_turbine_in_the_design_wind():
    grid = square_grid(GRIDS[0])
    assert stations("grid20", grid, 0).stations == GRID.fleet.stations
    assert len(within_reach(GRID)[1]) == len(grid)


def test_whole_times_are_rounded_up_by_less_than_a_unit():
    problem, _ = within_reach(GRID)
    k = len(problem.stations)
    legs = whole_times(problem, 0)[k:, k:] / UNITS - problem.t[0, 1:, 1:]
    assert (legs > -1e-7).all()
    assert (legs < 1 / UNITS).all()
    assert (np.array(whole_limits(problem)) <= UNITS * problem.t_max).all()


def test_others_can_read_the_instance_and_the_best_plan(tmp_path):
    n = len(GRID.farm)
    alone = {
        "instance": GRID.name,
        "hash": GRID.hash,
        "status": "feasible",
        "method": "each alone",
        "objective": 2e4,
        "bound": 1.0,
        "flights": [[1, [i]] for i in range(1, n + 1)],
    }
    (path,) = export([GRID.name], [alone], tmp_path)
    read = vrplib.read_instance(path)
    k = len(GRID.fleet)
    assert read["edge_weight"].shape == (k + n, k + n)
    assert read["dimension"] == len(read["demand"]) == k + n
    assert read["depot"].tolist() == list(range(k))
    plan = vrplib.read_solution(path.with_suffix(".sol"))
    trips = read["edge_weight"][0, k:] + read["edge_weight"][k:, 0]
    assert plan["cost"] == trips.sum()
    assert plan["bound"] == 1.0
