"""Quantisation against its two equations, evaluated entry by entry, and against its promises."""

from math import floor

import numpy as np
import pytest

from windopt.errors import InvalidInput
from windopt.forecasting.quantisation import (
    Levels,
    largest_code,
    pack,
    quantise,
    scale,
    unpack,
)

BITS = [2, 4, 8, 16]


def weights(shape=(40, 30), seed=0):
    return np.random.default_rng(seed).laplace(0, 0.1, shape).astype(np.float32)


@pytest.mark.parametrize("bits", BITS)
def test_every_entry_obeys_the_equation(bits):
    W = weights((5, 7)).astype(float)
    q, s = 2**bits - 1, float(np.float32(2.5 * np.median(np.abs(W))))
    for w, value in zip(W.flat, quantise(W, bits).values.flat, strict=True):
        x = min(max(w / s, -0.5), 0.5) + 0.5
        assert value == pytest.approx(s * (floor(q * x + 0.5) / q - 0.5), rel=1e-6)


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize("bits", BITS)
def test_a_level_is_an_integer_times_the_unit_and_there_are_few(bits, levels):
    found = quantise(weights(), bits, levels=levels)
    assert found.values == pytest.approx(found.unit * found.integers, rel=1e-6)
    assert found.codes.max() <= largest_code(bits, levels) < 2**bits
    assert len(np.unique(found.values)) <= 2**bits


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize("bits", BITS)
def test_levels_lie_symmetrically_around_zero(bits, levels):
    largest = largest_code(bits, levels)
    found = quantise(weights(), bits, levels=levels)
    mirrored = quantise(-weights() - 1e-12, bits, levels=levels)
    off = np.abs(found.codes.astype(int) + mirrored.codes - largest)
    assert off.max() <= 1  # one, where a weight lies half-way
    assert (off > 0).mean() < 0.01


def test_both_signs_survive():
    assert (quantise(weights(), 2).values < 0).any()
    assert (quantise(weights(), 2).values > 0).any()


def test_an_odd_number_of_steps_has_no_zero_and_the_other_set_has():
    for bits in BITS:
        assert (quantise(weights(), bits).integers % 2 == 1).all()
    ternary = quantise(weights(), 2, levels=Levels.ZERO).integers
    assert set(np.unique(ternary)) == {-1, 0, 1}
    assert 0.2 < (ternary == 0).mean() < 0.6


@pytest.mark.parametrize("levels", Levels)
def test_quantising_weights_that_are_on_the_levels_changes_none(levels):
    on_levels = quantise(weights(), 4, levels=levels)
    s = on_levels.s
    again = quantise(on_levels.values, 4, levels=levels, gamma=s / scale(on_levels.values, 1.0))
    assert (again.codes == on_levels.codes).all()


def test_finer_levels_lie_closer():
    W = weights()
    inside = np.abs(W) < scale(W) / 2
    error = [np.abs(quantise(W, bits).values - W)[inside].max() for bits in BITS]
    assert error == sorted(error, reverse=True)
    for bits, worst in zip(BITS, error, strict=True):
        assert worst <= scale(W) / (2 * (2**bits - 1)) * 1.001


def test_scaling_the_matrix_scales_the_levels():
    W = weights()
    assert quantise(8 * W, 4).values == pytest.approx(8 * quantise(W, 4).values)


def test_a_matrix_of_zeros_keeps_a_scale():
    assert np.isfinite(quantise(np.zeros((3, 3)), 4).values).all()
    assert quantise(np.zeros((3, 3)), 4, levels=Levels.ZERO).values.tolist() == [[0.0] * 3] * 3


@pytest.mark.parametrize("bits", [1, 3, 32])
def test_other_bit_widths_are_refused(bits):
    with pytest.raises(InvalidInput, match="bits"):
        quantise(weights(), bits)


@pytest.mark.parametrize("size", [1, 3, 8, 1001])
@pytest.mark.parametrize("bits", BITS)
def test_what_is_packed_is_unpacked(bits, size):
    codes = np.random.default_rng(size).integers(0, 2**bits, size).astype(np.uint16)
    packed = pack(codes, bits)
    assert packed.nbytes == -(-size * bits // 8)
    assert (unpack(packed, bits, size) == codes).all()


def test_a_truncated_packing_is_refused():
    with pytest.raises(InvalidInput, match="packed weights"):
        unpack(np.zeros(3, dtype=np.uint8), 4, 8)
