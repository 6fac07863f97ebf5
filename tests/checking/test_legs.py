"""The checker's times of legs against the planner's speeds, which it does not share."""

from math import inf

import numpy as np
import pytest

from formulations.wind_triangle import flight_time, ground_speed, ground_speed_paper
from windopt.checking.legs import airspeed, least_time, time_by_the_papers_rule
from windopt.domain.fleet import Uav
from windopt.domain.wind import Wind


@pytest.mark.parametrize("cap", [True, False])
def test_both_derivations_agree_in_any_wind(cap):
    rng = np.random.default_rng(0)
    for _ in range(2000):
        d, wind = rng.normal(0, 3000, 2), Wind(*rng.normal(0, 12, 2))
        uav = Uav(airspeed=rng.uniform(5, 25), ground_speed_cap=cap)
        speed = ground_speed(d, wind.velocity, uav.airspeed, cap=cap)
        expected = float(flight_time(d, speed))
        assert least_time(tuple(d), wind, uav) == pytest.approx(expected, rel=1e-9)


def test_both_forms_of_the_papers_rule_agree():
    rng = np.random.default_rng(1)
    for _ in range(1000):
        d, wind = rng.normal(0, 3000, 2), Wind(*rng.normal(0, 8, 2))
        uav = Uav(airspeed=rng.uniform(5, 25))
        expected = float(flight_time(d, ground_speed_paper(d, wind.velocity, uav.airspeed)))
        found = time_by_the_papers_rule(tuple(d), wind, uav)
        assert found == pytest.approx(expected, rel=1e-7)


def test_a_wind_as_fast_as_the_uav_carries_it_only_downwind():
    wind, uav = Wind(16.0, 0.0), Uav(airspeed=16.0, ground_speed_cap=False)
    assert least_time((1600.0, 0.0), wind, uav) == pytest.approx(50.0)
    assert least_time((-1600.0, 0.0), wind, uav) == inf
    assert least_time((0.0, 1600.0), wind, uav) == inf


def test_a_wind_too_strong_to_brake_in_breaks_the_cap():
    assert least_time((1000.0, 0.0), Wind(40.0, 0.0), Uav(airspeed=16.0)) == inf


def test_no_leg_is_flown_in_an_absurd_wind():
    assert least_time((1000.0, 0.0), Wind(1e308, 0.0), Uav()) == inf


def test_the_least_time_uses_the_whole_airspeed():
    wind, uav = Wind(3.0, -4.0), Uav(airspeed=16.0, ground_speed_cap=False)
    d = (700.0, 1200.0)
    assert airspeed(d, least_time(d, wind, uav), wind) == pytest.approx(16.0)
