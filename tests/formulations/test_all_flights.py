"""The choice among all flights of small farms, against enumeration of plans."""

import numpy as np
import pytest

import windopt
from formulations.all_flights import all_flights
from windopt.result import Status


def row(n=3):
    """Return times between a station and n turbines in a row, 100 s apart."""
    place = np.arange(n + 1)
    return 100.0 * abs(place[None, :] - place[:, None])


@pytest.mark.parametrize("times", ["wind", "paper", "any"])
@pytest.mark.parametrize("seed", range(10))
def test_optimum_equals_enumeration(seed, times, routing):
    t, t_max, allowed = routing.instances[times](seed, turbines=6, stations=3)
    expected = routing.cheapest(t, t_max, allowed)
    result = windopt.solve(all_flights(t, t_max, allowed=allowed))
    assert result.status is (Status.OPTIMAL if np.isfinite(expected) else Status.INFEASIBLE)
    assert result.objective == pytest.approx(expected, rel=1e-9)


def test_there_is_one_flight_for_each_set_that_fits():
    program = all_flights(row(), 400.0)
    assert sorted(path for _, path in program.flights) == [(0,), (0, 1), (1,)]


def test_a_plan_is_written_and_read_back():
    program = all_flights(np.tile(row(), (2, 1, 1)), 600.0)
    plan = [(0, (0,)), (1, (1, 2))]
    assert program.routes(program.point(plan)) == plan


def test_subset_rows_cut_off_half_flights():
    angle = 2 * np.pi * np.arange(3) / 3  # each pair fits a flight, all three do not
    xy = np.vstack([np.zeros(2), np.c_[np.cos(angle), np.sin(angle)]])
    t = np.hypot(*(xy[:, None] - xy[None]).T)
    program = all_flights(t, 4.0)
    half = np.array([0.5 if len(path) == 2 else 0.0 for _, path in program.flights])
    assert len(list(program.cuts(half))) == 1
    assert list(program.cuts(windopt.solve(program).found())) == []


def test_few_flights_leave_out_what_is_worth_least():
    result = windopt.solve(program := all_flights(row(), 400.0, most=1, prize=[50.0, 900.0, 900.0]))
    assert program.routes(result.found()) == [(0, (0, 1))]
    assert result.objective == pytest.approx(400.0 + 900.0)


def test_a_row_of_ones_own_joins():
    free = windopt.solve(all_flights(row(), 600.0)).objective
    program = all_flights(row(), 600.0)
    program.model.addConstr(program.x.sum() >= 2)
    assert windopt.solve(program).objective > free
