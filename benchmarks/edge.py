"""What quantisation buys on a small machine: bytes and time, one window at a time.

``python -m benchmarks.edge [--out FILE.csv]`` compares, in one process on one thread, torch
as it trains, ONNX Runtime in floats and with dynamic int8, and windopt's NumPy networks, each in
several bit widths and beside small networks in floating point. Times are minima of many runs: the
ratios carry over to other machines, the times do not. What is not installed is left out and said
so.
"""

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from benchmarks.csv_table import tabulate
from windopt.forecasting.calibration import Calibration
from windopt.forecasting.integer_network import IntegerNetwork
from windopt.forecasting.model import Model, Scaling
from windopt.forecasting.model_file import dumps
from windopt.forecasting.network import FloatNetwork, Single, Weights
from windopt.forecasting.quantisation import Levels
from windopt.forecasting.sparse_network import SparseNetwork
from windopt.forecasting.targets import ResidualTarget
from windopt.forecasting.windows import HISTORY, HORIZON

STEP = np.timedelta64(5, "m")
STEPS, AHEAD = 24, 8
REPEATS = 2000
HEADER = "network", "microseconds", "bytes"
Run = Callable[[Single], Any]


def random_weights(units: int = 100, seed: int = 0) -> Weights:
    """Return weights of a trained network's size; their values do not change any time."""
    rng = np.random.default_rng(seed)
    d, m = ResidualTarget.inputs, AHEAD * ResidualTarget.outputs
    shapes = (4 * units, d), (4 * units, units), (4 * units,), (m, units), (m,)
    return Weights(*(rng.normal(0, 0.1, shape).astype(np.float32) for shape in shapes))


def file_size(weights: Weights, bits: int, levels: Levels = Levels.HALF) -> int:
    """Return the bytes of a model's file."""
    d, k = ResidualTarget.inputs, ResidualTarget.outputs
    scaling = Scaling(*(np.ones(shape, np.float32) for shape in [(d,), (d,), (AHEAD, k)]))
    kept = weights if bits == 32 else weights.quantised(bits, levels=levels)
    model = Model("residual", STEP, HISTORY, HORIZON, kept, scaling, Calibration.none())
    return len(dumps(model))


def in_torch(weights: Weights) -> Iterator[tuple[str, Run]]:
    """Yield torch's LSTM: with oneDNN's kernel for the whole sequence, and operator by operator."""
    import torch

    torch.set_num_threads(1)
    n, d, m = weights.units, weights.W.shape[1], len(weights.b_y)
    lstm, output = torch.nn.LSTM(d, n, batch_first=True), torch.nn.Linear(n, m)
    values = {
        "weight_ih_l0": weights.W,
        "weight_hh_l0": weights.U,
        "bias_ih_l0": weights.b,
        "bias_hh_l0": np.zeros_like(weights.b),
    }
    lstm.load_state_dict({name: torch.from_numpy(value) for name, value in values.items()})
    output.load_state_dict(
        {"weight": torch.from_numpy(weights.W_y), "bias": torch.from_numpy(weights.b_y)}
    )

    def fused(x: Single) -> Any:
        with torch.no_grad():
            return output(lstm(torch.from_numpy(x))[0][:, -1]).numpy()

    def eager(x: Single) -> Any:
        with torch.backends.mkldnn.flags(enabled=False):
            return fused(x)

    yield "torch, one oneDNN kernel", fused
    yield "torch, operator by operator", eager


def in_onnx(weights: Weights) -> Iterator[tuple[str, Run]]:
    """Yield ONNX Runtime in floats, and with weights and activations in int8."""
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    options.log_severity_level = 3
    graph = onnx_graph(weights)
    for name, content in ("floats", graph), ("dynamic int8", in_int8(graph)):
        session = onnxruntime.InferenceSession(content, options, providers=["CPUExecutionProvider"])

        def run(x: Single, session: Any = session) -> Any:
            return session.run(None, {"x": x})[0]

        yield f"ONNX Runtime, {name}", run


def in_int8(graph: bytes) -> bytes:
    """Return the graph with its weights in int8 and its activations quantised as they come."""
    import onnx
    from onnxruntime.quantization import (
        QuantType,
        quantize_dynamic,
    )

    with TemporaryDirectory() as folder:
        small = Path(folder) / "int8.onnx"
        quantize_dynamic(onnx.load_from_string(graph), small, weight_type=QuantType.QInt8)
        return small.read_bytes()


def onnx_graph(weights: Weights) -> bytes:
    """Return the network as an ONNX graph; its gates are in the order i, o, f, c."""
    from onnx import TensorProto, helper, numpy_helper

    def reordered(array: Single) -> Single:
        i, f, c, o = np.split(array, 4)
        return np.concatenate([i, o, f, c])

    n, d, m = weights.units, weights.W.shape[1], len(weights.b_y)
    b = reordered(weights.b)
    constants = {
        "W": reordered(weights.W)[None],
        "R": reordered(weights.U)[None],
        "B": np.concatenate([b, np.zeros_like(b)])[None],
        "W_y": weights.W_y.T.copy(),
        "b_y": weights.b_y,
        "flat": np.array([-1, n]),
    }
    nodes = [
        helper.make_node("Transpose", ["x"], ["steps"], perm=[1, 0, 2]),
        helper.make_node("LSTM", ["steps", "W", "R", "B"], ["", "h"], hidden_size=n),
        helper.make_node("Reshape", ["h", "flat"], ["last"]),
        helper.make_node("MatMul", ["last", "W_y"], ["product"]),
        helper.make_node("Add", ["product", "b_y"], ["y"]),
    ]
    graph = helper.make_graph(
        nodes,
        "lstm",
        [helper.make_tensor_value_info("x", TensorProto.FLOAT, [1, STEPS, d])],
        [helper.make_tensor_value_info("y", TensorProto.FLOAT, [1, m])],
        [numpy_helper.from_array(value, name) for name, value in constants.items()],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    content: bytes = model.SerializeToString()
    return content


def products(weights: Weights) -> Run:
    """Return the products of matrix and vector of a float network, and nothing else."""
    A = np.asfortranarray(np.column_stack([weights.U, weights.W, weights.b]))
    a, out = np.ones(A.shape[1], np.float32), np.empty(len(A), np.float32)

    def run(x: Single) -> None:
        for _ in range(x.shape[1]):
            np.dot(A, a, out)

    return run


def in_numpy(weights: Weights) -> Iterator[tuple[str, Run, int | str]]:
    """Yield windopt's networks and the bytes of their files."""
    yield f"NumPy, the {STEPS} products of floats alone", products(weights), ""
    for units in 100, 50, 25, 16:
        small = random_weights(units)
        yield f"NumPy, floats, {units} units", FloatNetwork(small), file_size(small, 32)
    for bits in 8, 4, 2:
        integers = IntegerNetwork(weights.quantised(bits))
        yield f"NumPy, {bits}-bit weights, integers", integers, file_size(weights, bits)
    sparse = SparseNetwork(weights.quantised(4, gamma=2.5))
    name = f"NumPy, 4-bit weights, sparse codes, {sparse.zeros:.0%} zeros"
    yield name, sparse, file_size(weights, 4)
    ternary = SparseNetwork(weights.quantised(2, levels=Levels.ZERO))
    name = f"NumPy, ternary weights, sparse, {ternary.zeros:.0%} zeros"
    yield name, ternary, file_size(weights, 2, Levels.ZERO)


def fastest(run: Run, x: Single) -> float:
    """Return the shortest of many runs [us]."""
    shortest = float("inf")
    for _ in range(REPEATS):
        start = time.perf_counter()
        run(x)
        shortest = min(shortest, time.perf_counter() - start)
    return 1e6 * shortest


def measured() -> Iterator[tuple[str, float | str, int | str]]:
    """Yield what ran, its time [us], and the size of its model's file [bytes]."""
    weights = random_weights()
    x = np.random.default_rng(1).normal(size=(1, STEPS, ResidualTarget.inputs)).astype(np.float32)
    expected = FloatNetwork(weights)(x)
    for kind in in_torch, in_onnx:
        try:
            for name, run in kind(weights):
                if "int8" not in name:
                    np.testing.assert_allclose(run(x), expected, atol=1e-4)
                yield name, fastest(run, x), ""
        except ModuleNotFoundError as absent:
            yield f"{absent.name}: not installed", "", ""
    for name, run, size in in_numpy(weights):
        yield name, fastest(run, x), size


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table, and write it."""
    parser = argparse.ArgumentParser(description="Time and size of the network on small machines.")
    parser.add_argument("--out", type=Path, help="a CSV file for the table, beside printing it")
    chosen = parser.parse_args(arguments)
    found = ((name, f"{us:.0f}" if us else "", size) for name, us, size in measured())
    tabulate(chain([HEADER], found), chosen.out)


if __name__ == "__main__":
    main()
