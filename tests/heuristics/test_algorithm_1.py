"""The paper's rule against the exact answer, where it agrees and where it does not."""

from math import acos, cos, pi

import numpy as np
import pytest

from formulations.rotor import MODELS, power
from windopt.heuristics.algorithm_1 import algorithm_1, exceeds_rated

C_P = MODELS["slootweg"]
SG_8_167 = {"rho": 1.065, "A": 21_900.0, "p_rated": 8e6}


def available(w):
    return power(1.065, 21_900.0, w, 1.0, C_P.best().C_p)


@pytest.mark.parametrize("gamma_0", [0.0, 0.4, -2.0, pi])
def test_below_rated_it_faces_the_wind_and_is_optimal(gamma_0):
    point = algorithm_1(C_P, gamma_0, w=9.0, **SG_8_167)
    assert point.gamma == 0.0
    assert point.power == pytest.approx(available(9.0))


@pytest.mark.parametrize("gamma_0", [0.0, 0.4, -2.0, pi])
def test_above_rated_it_keeps_the_old_yaw(gamma_0):
    assert algorithm_1(C_P, gamma_0, w=14.0, **SG_8_167).gamma == gamma_0


def test_it_wastes_power_where_the_old_yaw_is_too_far_off():
    point = algorithm_1(C_P, 1.0, w=14.0, **SG_8_167)
    assert point.power == pytest.approx(available(14.0) * cos(1.0) ** 3)
    assert point.power < 0.5 * SG_8_167["p_rated"]
    assert algorithm_1(C_P, 2.0, w=14.0, **SG_8_167).power == 0.0


def test_without_pitch_it_would_exceed_the_rated_power_where_the_old_yaw_is_good_enough():
    assert exceeds_rated(C_P, 0.3, w=14.0, **SG_8_167)
    point = algorithm_1(C_P, 0.3, w=14.0, **SG_8_167)
    assert point.power == SG_8_167["p_rated"]
    assert point.beta > 0


def test_only_the_yaw_that_just_reaches_rated_power_is_right_without_pitch():
    reach = acos((SG_8_167["p_rated"] / available(14.0)) ** (1 / 3))
    assert exceeds_rated(C_P, 0.999 * reach, w=14.0, **SG_8_167)
    assert not exceeds_rated(C_P, 1.001 * reach, w=14.0, **SG_8_167)


@pytest.mark.parametrize("name", MODELS)
def test_it_never_beats_the_certified_maximum(name):
    rng = np.random.default_rng(0)
    for w, gamma_0 in zip(rng.uniform(3, 25, 100), rng.uniform(-pi, pi, 100), strict=True):
        point = algorithm_1(MODELS[name], gamma_0, w=w, **SG_8_167)
        most = power(1.065, 21_900.0, w, 1.0, MODELS[name].best().C_p)
        assert 0 <= point.power <= min(SG_8_167["p_rated"], most)
