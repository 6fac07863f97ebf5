"""The bound against enumeration, and against cases where it is known."""

import numpy as np
import pytest

from windopt.heuristics.relaxation import least_total_time


@pytest.mark.parametrize("seed", range(40))
def test_no_plan_is_shorter_than_the_bound(random_flights, enumerated, seed):
    instance = random_flights(seed, n=2 + seed % 4, k=1 + seed % 3)
    assert least_total_time(instance) <= enumerated(instance) * (1 + 1e-9)


def test_the_bound_of_one_turbine_is_its_round_trip(under_wind):
    instance = under_wind([(0.0, 0.0), (9000.0, 0.0)], [(1600.0, 0.0)])
    assert least_total_time(instance) == pytest.approx(200.0)


def test_turbines_that_need_a_flight_each_are_charged_one_each(under_wind):
    far_apart = [(4000.0, 0.0), (-4000.0, 0.0), (0.0, 4000.0)]
    instance = under_wind([(0.0, 0.0)], far_apart, t_max=500.0)
    assert least_total_time(instance) == pytest.approx(3 * 500.0)


def test_moving_the_farm_changes_nothing(random_flights, under_wind):
    a = random_flights(3)
    shift = np.array([4e5, 6e6])
    b = under_wind(a.stations + shift, a.turbines + shift, a.w, t_max=a.t_max[0])
    assert least_total_time(b) == pytest.approx(least_total_time(a))
