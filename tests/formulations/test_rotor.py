"""The rotor against published maxima, its own definition and an independent search."""

from math import cos, pi, radians

import casadi as ca
import numpy as np
import pytest
from scipy.ndimage import maximum_filter

from formulations.rotor import (
    MODELS,
    PITCH,
    TIP_SPEED_RATIO,
    operating_point,
    power,
    regulated,
)

NAMES = list(MODELS)
SG_8_167 = {"rho": 1.065, "A": 21_900.0, "p_rated": 8e6}


def grid(model, cells=600):
    lam = np.linspace(*TIP_SPEED_RATIO, cells + 1)
    beta = np.linspace(*PITCH, cells + 1)
    return model(lam[:, None], beta)


@pytest.mark.parametrize(
    ("name", "C_p", "lam"),
    [
        ("slootweg", 0.441, 6.91),
        ("heier", 0.411, 7.95),
        ("mathworks", 0.480, 8.10),
        ("dai", 0.4615, 6.38),
    ],
)
def test_the_published_maximum_is_found_at_zero_pitch(name, C_p, lam):
    best = MODELS[name].best()
    assert best.C_p == pytest.approx(C_p, abs=5e-4)  # as many digits as are published
    assert best.lam == pytest.approx(lam, abs=5e-3)
    assert best.beta == 0.0


@pytest.mark.parametrize("name", NAMES)
def test_no_random_point_of_the_box_beats_the_best(name):
    rng = np.random.default_rng(0)
    lam, beta = rng.uniform(*TIP_SPEED_RATIO, 10**6), rng.uniform(*PITCH, 10**6) ** 2 / PITCH[1]
    model = MODELS[name]
    assert model(lam, beta).max() <= model.best().C_p


@pytest.mark.parametrize("name", NAMES)
def test_a_model_has_one_hump_and_stays_below_the_betz_limit(name):
    C_p = grid(MODELS[name])
    peaks = (maximum_filter(C_p, 5, mode="nearest") == C_p) & (C_p > 0.01)
    assert peaks.sum() == 1
    assert np.isfinite(C_p).all()
    assert C_p.max() < 16 / 27


@pytest.mark.parametrize("name", NAMES)
def test_floats_arrays_and_symbols_agree(name):
    model = MODELS[name]
    lam, beta = ca.MX.sym("lam"), ca.MX.sym("beta")
    symbolic = ca.Function("C_p", [lam, beta], [model(lam, beta)])
    for point in (7.0, 0.0), (4.0, 12.5), (12.0, 3.0):
        assert float(symbolic(*point)) == pytest.approx(model(*point), rel=1e-12)
        assert model(*np.array(point)) == pytest.approx(model(*point), rel=1e-15)


@pytest.mark.parametrize("name", NAMES)
def test_the_symbolic_gradient_is_that_of_finite_differences(name):
    model, h = MODELS[name], 1e-6
    x = ca.MX.sym("x", 2)
    gradient = ca.Function("g", [x], [ca.gradient(model(x[0], x[1]), x)])
    for lam, beta in (7.0, 1.0), (4.0, 12.5), (12.0, 3.0):
        slopes = (
            (model(lam + h, beta) - model(lam - h, beta)) / (2 * h),
            (model(lam, beta + h) - model(lam, beta - h)) / (2 * h),
        )
        assert np.array(gradient([lam, beta])).ravel() == pytest.approx(slopes, abs=1e-8)


def test_power_follows_the_cube_of_the_cosine_as_in_the_papers_table():
    """129 kWh in the right direction became 127 kWh at 6 degrees off."""
    ratio = power(1.065, 21_900, 7.0, cos(radians(6)), 0.4) / power(1.065, 21_900, 7.0, 1, 0.4)
    assert ratio == pytest.approx(cos(radians(6)) ** 3)
    assert 129 * ratio == pytest.approx(127, abs=0.5)


@pytest.mark.parametrize("v", [1.0, 1.0 + 1e-9, 1.2, 1.6, 2.2, 3.0, 5.0])
@pytest.mark.parametrize("name", NAMES)
def test_a_regulated_rotor_delivers_its_rated_power(name, v):
    model = MODELS[name]
    lam, beta = regulated(model, v)
    assert model(lam, beta) * v**3 == pytest.approx(model.best().C_p, rel=1e-9)
    assert TIP_SPEED_RATIO[0] <= lam <= TIP_SPEED_RATIO[1]
    assert PITCH[0] <= beta <= PITCH[1]


def test_a_regulated_rotor_keeps_its_rated_speed_where_pitch_is_enough():
    model = MODELS["slootweg"]
    for v in 1.1, 1.5, 2.0:
        assert regulated(model, v)[0] * v == pytest.approx(model.best().lam)


def test_more_wind_never_means_less_power():
    powers = [
        operating_point(MODELS["slootweg"], 0.3, w=w, **SG_8_167).power
        for w in np.linspace(3, 25, 200)
    ]
    assert (np.diff(powers) >= 0).all()
    assert max(powers) == SG_8_167["p_rated"]


def test_a_rotor_turned_away_delivers_nothing():
    for gamma in pi / 2 + 0.01, pi, -2.0:
        assert operating_point(MODELS["slootweg"], gamma, w=20.0, **SG_8_167).power == 0
