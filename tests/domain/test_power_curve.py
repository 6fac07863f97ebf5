"""Power curves: what is tabulated, what stands in for it, and what they refuse."""

import numpy as np
import pytest

from windopt.domain.power_curve import PowerCurve
from windopt.domain.turbine import SG_8_167
from windopt.errors import InvalidInput

CURVE = PowerCurve((3.0, 10.0, 25.0), (0.0, 2e6, 1e6), (1.1, 0.8, 0.1))


def test_between_tabulated_speeds_it_is_linear_and_outside_nothing():
    assert CURVE.power([2.9, 6.5, 25.1]) == pytest.approx([0.0, 1e6, 0.0])
    assert CURVE.thrust([2.0, 3.0, 17.5, 30.0]) == pytest.approx([1e-4, 0.9999, 0.45, 1e-4])


def test_the_most_up_to_a_speed_may_lie_below_it():
    assert CURVE.most(6.5) == pytest.approx(1e6)
    assert CURVE.most(20.0) == CURVE.most(40.0) == 2e6
    assert CURVE.most(2.0) == 0.0


def test_a_stand_in_follows_the_cube_of_the_wind_up_to_its_rated_power():
    curve = SG_8_167.curve_by(0.44)
    w = np.array([6.0, 8.0, 9.0])
    assert curve.power(w) == pytest.approx(0.5 * 1.225 * 21_900 * 0.44 * w**3, rel=3e-4)
    assert curve.power([14.0, 24.9]) == pytest.approx(8e6)
    assert curve.power([2.9, 25.1]) == pytest.approx(0.0)


def test_a_stand_ins_thrust_is_usual_below_its_rated_power_and_falls_above():
    curve = SG_8_167.curve_by(0.44)
    assert curve.thrust([5.0, 9.0]) == pytest.approx(0.8)
    above = curve.thrust(np.linspace(12.0, 24.0, 20))
    assert (np.diff(above) < 0).all()
    assert 0 < above[-1] < 0.1


def test_a_scaled_turbine_scales_its_curve():
    half = SG_8_167.scaled_to(4e6).curve_by(0.44)
    whole = SG_8_167.curve_by(0.44)
    assert 2 * half.power(8.0) == pytest.approx(whole.power(8.0))
    assert CURVE.scaled(0.5).power(10.0) == pytest.approx(1e6)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"powers": (0.0, 1.0)}, "powers to hold 3 numbers, got 2"),
        ({"wind_speeds": (3.0, 3.0, 25.0)}, "wind_speeds to be two or more, increasing"),
        ({"powers": (0.0, -1.0, 0.0)}, "powers >= 0 and finite, got -1"),
        ({"thrust_coefficients": (0.0, np.nan, 0.0)}, "thrust_coefficients >= 0 and finite"),
        ({"yaw_exponent": 0.0}, "yaw_exponent > 0"),
    ],
)
def test_what_is_no_curve_is_refused(change, complaint):
    fields = {"wind_speeds": (3.0, 10.0, 25.0), "powers": (0.0, 1.0, 1.0)}
    with pytest.raises(InvalidInput, match=complaint):
        PowerCurve(**fields | {"thrust_coefficients": (0.5, 0.5, 0.5)} | change)
