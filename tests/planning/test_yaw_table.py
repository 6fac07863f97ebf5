"""Yaw tables: each cell is the plan of its wind, or better by a neighbour's answer."""

import numpy as np
import pytest

from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.io.floris import library_turbine
from windopt.planning import yaw
from windopt.planning.yaw import plan_yaw
from windopt.planning.yaw_table import TableOptions, plan_yaw_table
from windopt.result import Result, Status

NREL = library_turbine("nrel_5MW")
FARM = Farm("Row", tuple(Turbine(f"T{i}", 630.0 * i, 0.0, NREL) for i in range(3)))
DIRECTIONS = np.radians([0.0, 90.0, 270.5, 272.0])


def test_facing_the_wind_is_tabulated_as_it_is_planned():
    table = plan_yaw_table(FARM, [7.0, 9.0], DIRECTIONS, method="algorithm-1").found()
    for d, direction in enumerate(np.degrees(DIRECTIONS)):
        for v, speed in enumerate((7.0, 9.0)):
            plan = plan_yaw(FARM, Wind.from_met(speed, direction), method="algorithm-1")
            assert table.power[d, v] == pytest.approx(plan.objective)
            assert table.power_baseline[d, v] == pytest.approx(plan.found().power_baseline)
            assert table.bound[d, v] == pytest.approx(plan.bound)


def test_a_cell_takes_a_neighbours_answer_where_it_is_better(monkeypatch):
    def lucky(problem, *, time_limit, seed):
        steered = np.degrees(problem.wind_directions[0]) == pytest.approx(272.0)
        gamma = np.radians([20.0, 15.0, 0.0]) if steered else np.zeros(3)
        return Result(Status.LOCALLY_OPTIMAL, gamma, 0.0, np.inf, 0.0)

    monkeypatch.setitem(yaw.METHODS, "lucky", lucky)
    result = plan_yaw_table(FARM, [8.0, 9.0], DIRECTIONS, method="lucky")
    assert result.status is Status.FEASIBLE  # a neighbour's answer is no local optimum
    table = result.found()
    assert np.degrees(table.yaw[3]) == pytest.approx(np.array([[20.0, 15.0, 0.0]] * 2))
    assert table.power[2, 0] > table.power_baseline[2, 0]
    assert np.degrees(table.yaw[2]) == pytest.approx(np.degrees(table.yaw[3]))
    assert table.yaw[0] == pytest.approx(0.0)  # no wakes: facing the wind is best
    assert (table.power >= table.power_baseline).all()


def test_two_processors_tabulate_what_one_does():
    one, two = (
        plan_yaw_table(
            FARM,
            [8.0],
            DIRECTIONS,
            steering=Steering(direction_std=0.05),
            options=TableOptions(jobs=n),
        )
        for n in (1, 2)
    )
    assert (one.found().yaw == two.found().yaw).all()
    assert one.objective == two.objective <= one.bound


def test_no_time_leaves_the_rotors_facing_the_wind():
    result = plan_yaw_table(FARM, [8.0], DIRECTIONS, options=TableOptions(time_limit=0.0))
    assert result.status is Status.FEASIBLE
    assert not result.found().yaw.any()
    assert result.found().gain == 0.0


def test_ctrl_c_in_one_cell_ends_the_table(monkeypatch):
    asked = []

    def interrupted(problem, **_):
        asked.append(problem)
        return Result(Status.INTERRUPTED, problem.facing, 0.0, problem.bound, 0.0)

    monkeypatch.setitem(yaw.METHODS, "nlp", interrupted)
    result = plan_yaw_table(FARM, [7.0, 8.0], DIRECTIONS)
    assert result.status is Status.INTERRUPTED
    assert len(asked) == 1


def test_progress_is_told():
    told = []
    plan_yaw_table(FARM, [8.0], DIRECTIONS, done=lambda *counts: told.append(counts))
    assert told == [(1, 4), (2, 4), (3, 4), (4, 4)]


@pytest.mark.parametrize(
    ("speeds", "directions", "field"),
    [
        ([], [0.0], "speeds"),
        ([8.0, 8.0], [0.0], "speeds"),
        ([-1.0], [0.0], "speeds"),
        ([np.nan], [0.0], "speeds"),
        ([8.0], [0.0, 2 * np.pi], "directions"),
    ],
)
def test_axes_must_increase(speeds, directions, field):
    with pytest.raises(InvalidInput, match=f"{field} to increase"):
        plan_yaw_table(FARM, speeds, directions)
