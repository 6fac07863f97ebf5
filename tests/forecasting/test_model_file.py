"""Model files: what is saved is loaded, and what is broken is refused."""

import io
import json
import pickle
import zipfile

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from windopt.errors import InvalidInput
from windopt.forecasting.calibration import Calibration
from windopt.forecasting.model import Model, Scaling
from windopt.forecasting.model_file import dumps, load, loads, save
from windopt.forecasting.network import FloatNetwork, Weights
from windopt.forecasting.quantisation import Levels
from windopt.forecasting.targets import ResidualTarget
from windopt.forecasting.windows import HISTORY, HORIZON, Traces

STEP = np.timedelta64(5, "m")


def model(bits=4, output_bits=None, n=6, levels=Levels.HALF, seed=0):
    rng = np.random.default_rng(seed)
    d = ResidualTarget.inputs
    shapes = (4 * n, d), (4 * n, n), (4 * n,), (88, n), (88,)
    weights = Weights(*(rng.normal(0, 0.2, shape).astype(np.float32) for shape in shapes))
    scaling = Scaling(*(np.full(shape, 1.5, np.float32) for shape in [(d,), (d,), (8, 11)]))
    chosen = weights if bits == 32 else weights.quantised(bits, output_bits, levels=levels)
    factors = np.array([1.25, 1.5, 1.0, 0.5, 0.75]) * np.ones((8, 1))
    calibration = Calibration(factors, factors[:, ::-1].copy(), (0.5, 0.25))
    return Model("residual", STEP, HISTORY, HORIZON, chosen, scaling, calibration)


def past(B=20):
    rng = np.random.default_rng(0)
    return Traces(rng.uniform(2, 12, (B, 24)), rng.uniform(0, 6, (B, 24)))


@pytest.mark.parametrize("levels", Levels)
@pytest.mark.parametrize("bits", [2, 4, 8, 16, 32])
def test_what_is_saved_forecasts_the_same_when_loaded(tmp_path, bits, levels):
    saved = model(bits, levels=levels)
    save(saved, tmp_path / "model.npz")
    loaded = load(tmp_path / "model.npz")
    before, after = (m.forecast(FloatNetwork(m.float_weights), past()) for m in (saved, loaded))
    assert (after.speed == before.speed).all()
    assert (after.theta_met == before.theta_met).all()
    assert (after.quantiles.turn == before.quantiles.turn).all()
    assert loaded.calibration.memory == saved.calibration.memory


def test_gates_and_output_may_have_different_bits():
    loaded = loads(dumps(model(2, 8)))
    assert [matrix.bits for matrix in loaded.weights.matrices] == [2] * 8 + [8]


def test_four_bits_take_an_eighth_of_the_room_less_what_is_not_quantised():
    sizes = {bits: len(dumps(model(bits, n=100))) for bits in (2, 4, 8, 32)}
    assert sizes[32] / sizes[4] > 7.4
    assert sizes[32] / sizes[2] > 13
    assert sizes[32] / sizes[8] > 3.8


def test_a_file_is_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "model.npz"
    save(model(seed=1), path)
    before = path.read_bytes()
    with pytest.raises(AttributeError):
        save(None, path)
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == ["model.npz"]


def test_the_same_model_gives_the_same_bytes():
    assert dumps(model()) == dumps(model())


@pytest.mark.parametrize("length", [0, 1, 100, 1000, -1])
def test_a_truncated_file_is_refused(length):
    with pytest.raises(InvalidInput):
        loads(dumps(model())[:length])


@settings(max_examples=300, deadline=None)
@given(at=st.integers(0, 10**6), value=st.integers(0, 255))
def test_a_flipped_byte_is_refused_or_harmless(at, value):
    content = bytearray(dumps(model()))
    content[at % len(content)] = value
    try:
        found = loads(bytes(content))
    except InvalidInput:
        return
    assert np.isfinite(found.float_weights.U).all()


class Exploit:
    def __reduce__(self):
        return pytest.fail, ("a model file ran code",)


def test_a_pickled_file_is_refused_unread(tmp_path):
    path = tmp_path / "model.npz"
    path.write_bytes(pickle.dumps(Exploit()))
    with pytest.raises(InvalidInput):
        load(path)
    arrays = {key: np.array([Exploit()], dtype=object) for key in ("header", "packed", "floats")}
    np.savez(path, **arrays)
    with pytest.raises(InvalidInput):
        load(path)


def changed(**arrays):
    """Return the bytes of a file of which some arrays were replaced."""
    with np.load(io.BytesIO(dumps(model()))) as whole:
        parts = dict(whole) | arrays
    buffer = io.BytesIO()
    np.savez(buffer, **parts)
    return buffer.getvalue()


def test_a_file_that_would_swell_when_read_is_refused():
    buffer = io.BytesIO()
    np.savez_compressed(buffer, header=np.zeros(10**7, dtype=np.uint8))
    with pytest.raises(InvalidInput, match="compression"):
        loads(buffer.getvalue())


def header(**entries):
    """Return a header of which some entries were replaced."""
    with np.load(io.BytesIO(dumps(model()))) as whole:
        found = json.loads(whole["header"].tobytes())
    return np.frombuffer(json.dumps(found | entries).encode(), dtype=np.uint8)


@pytest.mark.parametrize(
    "content",
    [
        changed(header=header(**{"windopt model": 2})),
        changed(header=header(target="oracle")),
        changed(header=header(minutes=[0, 120, 40])),
        changed(header=header(minutes=[5, 120])),
        changed(header=header(units=7)),
        changed(header=header(units=-6)),
        changed(header=header(bits=[3, 3])),
        changed(header=header(bits=[4])),
        changed(header=header(levels="many")),
        changed(header=np.frombuffer(b"[1, 2]", dtype=np.uint8)),
        changed(packed=np.zeros(10, dtype=np.uint8)),
        changed(packed=np.zeros(10)),
        changed(packed=np.full(620, 255, dtype=np.uint8)),
        changed(floats=np.full(200, np.nan, dtype=np.float32)),
        changed(floats=np.zeros(7, dtype=np.float32)),
    ],
)
def test_files_that_contradict_themselves_are_refused(content):
    with pytest.raises(InvalidInput):
        loads(content)


def test_a_file_that_is_no_model_or_is_not_there_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match="readable"):
        load(tmp_path / "none.npz")
    with zipfile.ZipFile(tmp_path / "empty.npz", "w"):
        pass
    with pytest.raises(InvalidInput, match="whole"):
        load(tmp_path / "empty.npz")
