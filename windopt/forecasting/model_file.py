"""Model files: one ``.npz`` with packed weights and nothing that runs when read.

A file holds three arrays: ``header`` (JSON as bytes: version, sizes, bits, durations), ``packed``
(bytes: the nine quantised matrices one after the other, then the biases, float16 beside weights of
up to 8 bits, else float32) and ``floats`` (float32: scaling, calibration, and either the scales of
the matrices or, in floating point, the matrices themselves). Every array costs a quarter of a
kilobyte to name, so there are no more.
"""

import io
import json
import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput
from windopt.forecasting.calibration import CLASSES, Calibration
from windopt.forecasting.model import Model, Scaling
from windopt.forecasting.network import QuantisedWeights, Weights
from windopt.forecasting.quantisation import FLOAT, Levels, Quantised, pack, unpack
from windopt.forecasting.targets import LEVELS, TARGETS, Target

VERSION = 1
SIZE_LIMIT = 64 * 2**20  # bytes; no model of this kind comes near
SINGLE = np.dtype("<f4")
OUTER = [j for j, level in enumerate(LEVELS) if level != 0.5]  # the median is not calibrated


def dumps(model: Model) -> bytes:
    """Return the bytes of the model's file."""
    weights, scaling, calibration = model.weights, model.scaling, model.calibration
    matrices = weights.matrices if isinstance(weights, QuantisedWeights) else ()
    bits = [matrices[0].bits, matrices[-1].bits] if matrices else [FLOAT, FLOAT]
    header = {
        "windopt model": VERSION,
        "target": model.target,
        "minutes": [_minutes(t) for t in (model.step, model.history, model.horizon)],
        "units": model.units,
        "bits": bits,
        "levels": (matrices[0].levels if matrices else Levels.HALF).value,
    }
    biases = np.concatenate([weights.b, weights.b_y])
    floats: list[NDArray[Any]] = [
        scaling.mean,
        scaling.deviation,
        scaling.outputs[:, _first(model.way)],
        calibration.speed[:, OUTER],
        calibration.turn[:, OUTER],
        np.array(calibration.memory),
    ]
    codes = np.zeros(0, dtype=np.uint8)
    if isinstance(weights, Weights):
        floats += [weights.W, weights.U, weights.W_y]
    else:
        floats.append(np.array([matrix.s for matrix in matrices]))
        codes = np.concatenate([pack(matrix.codes, matrix.bits) for matrix in matrices])
    buffer = io.BytesIO()
    np.savez(
        buffer,
        header=np.frombuffer(json.dumps(header, separators=(",", ":")).encode(), dtype=np.uint8),
        packed=np.concatenate([codes, biases.astype(_bias_type(bits)).view(np.uint8)]),
        floats=np.concatenate([np.ravel(array) for array in floats]).astype(SINGLE),
    )
    return buffer.getvalue()


def loads(content: bytes, name: str = "model file") -> Model:
    """Return the model in a file's bytes.

    Raises
    ------
    InvalidInput
        If they are truncated, corrupted, pickled, of another version, or contradict themselves.
    """
    if len(content) > SIZE_LIMIT:
        raise InvalidInput(name, f"of at most {SIZE_LIMIT} bytes", len(content))
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            if any(entry.compress_type != zipfile.ZIP_STORED for entry in archive.infolist()):
                raise InvalidInput(name, "without compression", "entries that could swell")
        with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
            header = json.loads(arrays["header"].tobytes().decode())
            packed, floats = arrays["packed"], arrays["floats"]
        return _model(header, packed, _Reader(floats))
    except InvalidInput:
        raise
    except (
        OSError, ValueError, KeyError, TypeError, EOFError, IndexError, AttributeError,
        OverflowError, NotImplementedError, MemoryError, zipfile.BadZipFile,
    ) as broken:  # fmt: skip
        raise InvalidInput(name, "to be a whole windopt model", f"damage: {broken}") from broken


def save(model: Model, path: Path) -> None:
    """Write the model's file, whole or not at all."""
    unfinished = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with unfinished.open("wb") as file:
            file.write(dumps(model))
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def load(path: Path) -> Model:
    """Read a model's file; see :func:`loads`."""
    try:
        content = path.read_bytes()
    except OSError as missing:
        raise InvalidInput("model file", "to be readable", missing) from missing
    return loads(content, f"model file {path.name}")


class _Reader:
    """Takes arrays from one flat array, in order."""

    def __init__(self, floats: NDArray[Any]) -> None:
        if floats.dtype != SINGLE or floats.ndim != 1 or not np.isfinite(floats).all():
            raise InvalidInput("floats", "finite float32 in one row", floats.dtype)
        self._rest = floats.astype(np.float32)

    def take(self, *shape: int) -> NDArray[np.float32]:
        """Return the next array of ``shape``."""
        size = int(np.prod(shape))
        if len(self._rest) < size:
            raise InvalidInput("floats", f"{size} more", len(self._rest))
        taken, self._rest = self._rest[:size], self._rest[size:]
        return taken.reshape(shape)

    def end(self) -> None:
        """Raise unless all has been taken."""
        if len(self._rest):
            raise InvalidInput("floats", "no more", len(self._rest))


def _model(header: dict[str, Any], packed: NDArray[Any], floats: _Reader) -> Model:
    if header.get("windopt model") != VERSION:
        raise InvalidInput("version of model file", f"{VERSION}", header.get("windopt model"))
    if header["target"] not in TARGETS:
        raise InvalidInput("target", f"among {', '.join(TARGETS)}", header["target"])
    step, history, horizon = (np.timedelta64(int(m), "m") for m in header["minutes"])
    way, n = TARGETS[header["target"]], int(header["units"])
    if not step > np.timedelta64(0):
        raise InvalidInput("step", "> 0", step)
    H = int(horizon / step)
    d, m = way.inputs, H * way.outputs
    mean, deviation = floats.take(d), floats.take(d)
    scaling = Scaling(mean, deviation, floats.take(H, len(_first(way)))[:, way.columns])
    speed, turn = np.ones((2, CLASSES, len(LEVELS)))
    for factors in speed, turn:
        factors[:, OUTER] = floats.take(CLASSES, len(OUTER))
    a, b = (float(x) for x in floats.take(2))
    weights = _weights(header, packed, floats, (n, d, m))
    floats.end()
    return Model(
        header["target"], step, history, horizon, weights, scaling, Calibration(speed, turn, (a, b))
    )


def _weights(
    header: dict[str, Any], packed: NDArray[Any], floats: _Reader, sizes: tuple[int, int, int]
) -> Weights | QuantisedWeights:
    """Weights of n units, d inputs and m outputs."""
    n, d, m = sizes
    bits, output_bits = (int(b) for b in header["bits"])
    shapes = [(n, d)] * 4 + [(n, n)] * 4 + [(m, n)]
    widths = [] if bits == FLOAT else [bits] * 8 + [output_bits]
    lengths = [-(-a * b * k // 8) for (a, b), k in zip(shapes, widths, strict=False)]
    kind = _bias_type([bits, output_bits])
    if packed.dtype != np.uint8 or packed.shape != (sum(lengths) + (4 * n + m) * kind.itemsize,):
        raise InvalidInput("packed weights", "as long as the header says", packed.shape)
    *codes, rest = np.split(packed, np.cumsum(lengths))
    b, b_y = np.split(rest.view(kind).astype(np.float32), [4 * n])
    if bits == FLOAT:
        return Weights(floats.take(4 * n, d), floats.take(4 * n, n), b, floats.take(m, n), b_y)
    levels, scales = Levels(header["levels"]), floats.take(9)
    matrices = tuple(
        Quantised(unpack(part, k, rows * columns).reshape(rows, columns), float(s), k, levels)
        for part, (rows, columns), k, s in zip(codes, shapes, widths, scales, strict=True)
    )
    return QuantisedWeights(matrices[:4], matrices[4:8], b, matrices[8], b_y)


def _bias_type(bits: list[int]) -> np.dtype[Any]:
    return np.dtype("<f2") if max(bits) <= 8 else SINGLE


def _first(way: Target) -> list[int]:
    """Return the first output about each component of the truth: all about one share a scale."""
    return [way.columns.index(component) for component in range(max(way.columns) + 1)]


def _minutes(duration: np.timedelta64) -> int:
    return int(duration / np.timedelta64(1, "m"))
