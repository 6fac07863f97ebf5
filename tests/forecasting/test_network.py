"""The three ways to run the network, against its equations written entry by entry in Python."""

from math import exp, floor, log2, tanh

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.forecasting.integer_network import IntegerNetwork
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.network import FloatNetwork, Weights
from windopt.forecasting.quantisation import Levels
from windopt.forecasting.sparse_network import SparseMatrix, SparseNetwork


def weights(n=10, d=3, m=4, seed=0, size=0.3):
    rng = np.random.default_rng(seed)
    shapes = (4 * n, d), (4 * n, n), (4 * n,), (m, n), (m,)
    return Weights(*(rng.normal(0, size, shape).astype(np.float32) for shape in shapes))


def inputs(B=5, L=12, d=3, seed=1):
    return np.random.default_rng(seed).normal(0, 1.5, (B, L, d)).astype(np.float32)


def by_the_equations(w, x):
    """One window ``(L, d)`` through the equations, in float64."""

    def logistic(z):
        return 1 / (1 + np.exp(-z))

    h = c = np.zeros(w.units)
    for now in x.astype(float):
        i, f, g, o = np.split(w.W @ now + w.U @ h + w.b, 4)
        c = logistic(f) * c + logistic(i) * np.tanh(g)
        h = logistic(o) * np.tanh(c)
    return w.W_y @ h + w.b_y


def in_python_integers(w, x):
    """One window through integer arithmetic, without NumPy's: the independent reference."""
    one, n = 4096, len(w.U[0].codes)
    gates = []
    for k, (W, U) in enumerate(zip(w.W, w.U, strict=True)):
        unit = U.unit / one
        r = round(65536 * W.unit / 256 / unit)
        b = w.b[k * n : (k + 1) * n].astype(float)
        beta = [round(65536 * value / unit) for value in b.tolist()]
        shift = max(0, floor(log2(2.0**-9 / unit)))
        gates.append((W.integers.tolist(), U.integers.tolist(), r, beta, shift, unit))

    def activation(k, total, shift, unit):
        middle = ((total >> shift) + 0.5) * unit * 2**shift
        return round(one * (tanh(middle) if k == 2 else 1 / (1 + exp(-middle))))

    h, c = [0] * n, [0] * n
    for now in x.tolist():
        z = [max(-2048, min(2048, round(256 * value))) for value in now]
        values = []
        for k, (W, U, r, beta, shift, unit) in enumerate(gates):
            row = []
            for j in range(n):
                driven = (
                    r * sum(a * b for a, b in zip(W[j], z, strict=True)) + beta[j] + 32768
                ) >> 16
                total = driven + sum(a * b for a, b in zip(U[j], h, strict=True))
                row.append(activation(k, total, shift, unit))
            values.append(row)
        i, f, g, o = values
        c = [round((f[j] * c[j] + i[j] * g[j]) / one) for j in range(n)]
        h = [round(o[j] * round(one * tanh(c[j] / one)) / one) for j in range(n)]
    return [sum(a * b for a, b in zip(row, h, strict=True)) for row in w.W_y.integers.tolist()]


def test_floats_obey_the_equations():
    w, x = weights(), inputs()
    expected = [by_the_equations(w, window) for window in x]
    assert FloatNetwork(w)(x) == pytest.approx(np.array(expected), abs=1e-5)


@pytest.mark.parametrize("kind", ["float", "integer", "sparse"])
def test_a_window_alone_gives_what_it_gives_among_others(kind):
    w, x = weights().quantised(4), inputs()
    network = {
        "float": FloatNetwork(w.weights),
        "integer": IntegerNetwork(w),
        "sparse": SparseNetwork(w),
    }[kind]
    alone = np.concatenate([network(window[None]) for window in x])
    assert network(x) == pytest.approx(alone, abs=1e-6)


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize("bits", [2, 4, 8])
def test_integers_are_exact_to_the_last_bit(bits, levels):
    w = weights(seed=bits).quantised(bits, levels=levels)
    x = inputs(B=56, L=6, seed=bits)  # 6 x 56 windows; the slow test has a thousand
    expected = [in_python_integers(w, window) for window in x]
    assert IntegerNetwork(w).sums(x).tolist() == expected


@pytest.mark.slow
def test_integers_are_exact_on_a_thousand_windows_of_the_full_size():
    w = weights(n=100, d=8, m=88, size=0.1).quantised(4)
    x = inputs(B=1000, L=3, d=8)
    network = IntegerNetwork(w)
    assert network.exact is np.float32
    assert network.sums(x).tolist() == [in_python_integers(w, window) for window in x]


@pytest.mark.slow
@pytest.mark.parametrize("minutes", [5, 10])
def test_integers_are_exact_on_the_shipped_models(minutes):
    model = EdgeForecaster.shipped(np.timedelta64(minutes, "m")).model
    x = inputs(B=20, L=120 // minutes, d=8)
    expected = [in_python_integers(model.weights, window) for window in x]
    assert IntegerNetwork(model.weights).sums(x).tolist() == expected


@pytest.mark.parametrize("bits", [2, 4, 8])
def test_integers_come_close_to_floats(bits):
    w, x = weights(n=40).quantised(bits), inputs(B=50)
    floats = FloatNetwork(w.weights)(x)
    assert np.abs(IntegerNetwork(w)(x) - floats).max() < 0.01 * np.abs(floats).max()


def test_large_sums_move_to_float64_and_stay_exact():
    w = weights(n=12, size=0.1)
    w.b[:] = 200.0  # arguments far beyond what float32 counts in these units
    quantised = w.quantised(8)
    assert IntegerNetwork(quantised).exact is np.float64
    x = inputs(B=4, L=5)
    expected = [in_python_integers(quantised, window) for window in x]
    assert IntegerNetwork(quantised).sums(x).tolist() == expected


def test_inputs_beyond_the_limit_are_cut():
    w = weights().quantised(4)
    network = IntegerNetwork(w)
    assert (network.sums(1e6 * inputs()) == network.sums(8 * np.sign(inputs()))).all()


def test_more_than_eight_bits_are_no_integers():
    with pytest.raises(InvalidInput, match="8"):
        IntegerNetwork(weights().quantised(16))


def test_a_history_beyond_the_table_is_refused():
    with pytest.raises(InvalidInput, match="history"):
        IntegerNetwork(weights().quantised(4), steps=8)(inputs(L=9))


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize("bits", [2, 4, 8])
def test_sparse_products_are_the_dense_ones(bits, levels):
    w, x = weights(n=40).quantised(bits, levels=levels), inputs()
    assert SparseNetwork(w)(x) == pytest.approx(FloatNetwork(w.weights)(x), abs=1e-5)


def test_both_sets_of_levels_have_zeros_to_leave_out():
    w = weights(n=60)
    ternary = w.quantised(2, levels=Levels.ZERO)
    assert SparseNetwork(ternary).zeros == pytest.approx((ternary.weights.U == 0).mean())
    assert 0.1 < SparseNetwork(w.quantised(4)).zeros < 0.35
    dense = SparseMatrix(w.quantised(4).W_y)
    assert dense.zeros == pytest.approx((w.quantised(4).W_y.codes == 0).mean())


def test_each_gate_has_its_own_scale_and_keeps_its_place():
    w = weights()
    w.W[:10] *= 50
    quantised = w.quantised(8)
    assert quantised.W[0].s > 20 * quantised.W[1].s
    assert np.abs(quantised.weights.W - w.W)[10:].max() < 1.0
    assert quantised.weights.W.shape == w.W.shape


def test_gates_and_output_are_rounded_apart():
    w = weights()
    assert (w.rounded(32, 4).U == w.U).all()
    assert len(np.unique(w.rounded(32, 2).W_y)) <= 4
    assert (w.rounded(4, 32).W_y == w.W_y).all()
    assert len(np.unique(w.rounded(4, 32).U[:10])) <= 16


def test_weights_that_do_not_fit_each_other_are_refused():
    w = weights()
    with pytest.raises(InvalidInput, match="weights W_y"):
        Weights(w.W, w.U, w.b, w.W_y[:, :3], w.b_y)
    with pytest.raises(InvalidInput, match="finite"):
        Weights(w.W, w.U * np.float32("nan"), w.b, w.W_y, w.b_y)
