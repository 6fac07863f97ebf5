"""The wind triangle against cases solved by hand, and against its own geometry."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from formulations.wind_triangle import flight_time, ground_speed, ground_speed_paper

U_MAX = 16.0
EAST, NORTH = np.array([1000.0, 0.0]), np.array([0.0, 1000.0])

speeds = st.floats(0.0, 40.0)
angles = st.floats(0.0, 2 * np.pi)
points = st.tuples(st.floats(-5000, 5000), st.floats(-5000, 5000)).map(np.array)


def wind(speed, angle):
    return speed * np.array([np.cos(angle), np.sin(angle)])


def time(d, w, **options):
    return flight_time(d, ground_speed(d, w, U_MAX, **options))


@pytest.mark.parametrize(
    ("d", "w", "capped", "free"),
    [
        (EAST, [0.0, 0.0], 16.0, 16.0),
        (EAST, [10.0, 0.0], 16.0, 26.0),
        (-EAST, [10.0, 0.0], 6.0, 6.0),
        (NORTH, [10.0, 0.0], np.sqrt(156.0), np.sqrt(156.0)),
        (NORTH, [16.0, 0.0], 0.0, 0.0),
        (-EAST, [16.0, 0.0], 0.0, 0.0),
        (EAST, [16.0, 0.0], 16.0, 32.0),
        (NORTH, [20.0, 0.0], 0.0, 0.0),
        (EAST, [40.0, 0.0], 0.0, 56.0),  # 24 m/s over ground at the least
    ],
)
def test_ground_speed_of_cases_solved_by_hand(d, w, capped, free):
    assert ground_speed(d, np.array(w), U_MAX) == pytest.approx(capped, abs=1e-12)
    assert ground_speed(d, np.array(w), U_MAX, cap=False) == pytest.approx(free, abs=1e-12)


@given(points, speeds, angles)
def test_airspeed_and_ground_speed_keep_their_limits(d, speed, angle):
    w = wind(speed, angle)
    s = ground_speed(d, w, U_MAX)
    distance = np.hypot(*d)
    if s > 0 and distance > 0:
        assert np.hypot(*(s * d / distance - w)) <= U_MAX * (1 + 1e-9)
        assert s <= U_MAX


@given(points, points, speeds, angles, st.booleans())
def test_a_detour_is_never_shorter(a, b, speed, angle, cap):
    w = wind(speed, angle)
    direct, first, second = (time(leg, w, cap=cap) for leg in (a + b, a, b))
    # Legs near the edge of what can be flown amplify rounding: compare times up to a day.
    if first + second < 86400:
        assert direct <= (first + second) * (1 + 1e-6) + 1e-6


@given(points, speeds, angles, angles)
def test_turning_leg_and_wind_together_changes_nothing(d, speed, angle, turn):
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])
    w = wind(0.9 * speed, angle)
    expected, turned = ground_speed(d, w, U_MAX), ground_speed(rotation @ d, rotation @ w, U_MAX)
    if expected > 1e-3 and turned > 1e-3:  # Below, rounding decides whether the leg can be flown.
        assert turned == pytest.approx(expected, abs=1e-4)


@given(points, speeds, angles)
def test_flying_back_is_flying_out_in_the_opposite_wind(d, speed, angle):
    w = wind(speed, angle)
    assert ground_speed(-d, w, U_MAX) == ground_speed(d, -w, U_MAX)


@given(points, speeds, angles, st.floats(0.1, 10.0))
def test_speeds_scale_together(d, speed, angle, scale):
    w = wind(speed, angle)
    expected = scale * ground_speed(d, w, U_MAX, cap=False)
    got = ground_speed(d, scale * w, scale * U_MAX, cap=False)
    if min(expected, got) > 1e-3:
        assert got == pytest.approx(expected, rel=1e-5)


def test_the_paper_agrees_in_head_wind_and_overspeeds_near_the_beam():
    w = np.array([10.0, 0.0])
    head = np.array([[-1000.0, y] for y in (-800.0, 0.0, 500.0)])
    assert_allclose(ground_speed_paper(head, w, U_MAX), ground_speed(head, w, U_MAX))
    beam = np.array([1.0, 1000.0])
    assert ground_speed_paper(beam, w, U_MAX) == U_MAX
    assert ground_speed(beam, w, U_MAX) < 12.6
    assert np.hypot(*(U_MAX * beam / np.hypot(*beam) - w)) > 18.0


def test_a_leg_of_no_length_takes_no_time_in_any_wind():
    nowhere = np.zeros((3, 2))
    for speed in 0.0, 10.0, 16.0, 30.0:
        assert_allclose(time(nowhere, wind(speed, 1.0)), 0.0)


def test_a_leg_that_cannot_be_flown_takes_forever():
    assert time(-EAST, np.array([16.0, 0.0])) == np.inf


def test_all_legs_at_once_are_the_legs_one_by_one():
    d = np.random.default_rng(0).normal(size=(4, 5, 2))
    together = ground_speed(d, np.array([3.0, -7.0]), U_MAX)
    assert together.shape == (4, 5)
    assert together[2, 3] == ground_speed(d[2, 3], np.array([3.0, -7.0]), U_MAX)
