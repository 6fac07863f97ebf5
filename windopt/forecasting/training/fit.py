"""From measured series to a trained model: windows, scaling, training, rounding, calibration."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np
import torch

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.calibration import Calibration, calibrate
from windopt.forecasting.faults import without_faults
from windopt.forecasting.model import Model, Scaling
from windopt.forecasting.network import FloatNetwork, QuantisedWeights, Weights
from windopt.forecasting.quantisation import FLOAT, Levels
from windopt.forecasting.targets import TARGETS, ResidualTarget, Target
from windopt.forecasting.training.loop import Epoch, Examples, Schedule, train
from windopt.forecasting.training.losses import Loss, raw_loss, residual_loss
from windopt.forecasting.training.module import Shape
from windopt.forecasting.windows import (
    HISTORY,
    HORIZON,
    Traces,
    Windows,
    chronological_split,
    windows,
)


@dataclass(frozen=True)
class Recipe:
    """What to train.

    Parameters
    ----------
    history, horizon
        How far to look back and ahead.
    target
        ``"residual"`` (ours) or ``"raw"`` (the paper's).
    units
        Hidden units.
    bits, output_bits
        omega_w and omega_f.
    levels, gamma
        Which levels the weights take, and how many medians wide they span: the default of 8 lets
        few weights saturate at 4 bits; the paper's 2.5 cuts off two fifths of them.
    stride
        Rows from one training window to the next: neighbours share all but one row, and teach
        little that is new.
    validation
        The last fraction of each series, kept for early stopping and calibration.
    schedule, refinement
        Of training in floating point, and of going on with the weights on their levels: rounding
        from the start slows learning down.
    """

    history: np.timedelta64 = HISTORY
    horizon: np.timedelta64 = HORIZON
    target: str = "residual"
    units: int = 100
    bits: int = 4
    output_bits: int | None = None
    levels: Levels = Levels.HALF
    gamma: float = 8.0
    stride: int = 2
    validation: float = 0.12
    schedule: Schedule = field(default_factory=Schedule)
    refinement: Schedule = field(default_factory=lambda: Schedule(epochs=8, rate=1.5e-3))

    def __post_init__(self) -> None:
        if self.target not in TARGETS:
            raise InvalidInput("target", f"among {', '.join(TARGETS)}", self.target)
        for name in "units", "stride":
            if getattr(self, name) < 1:
                raise InvalidInput(name, ">= 1", getattr(self, name))


def fit(
    recipe: Recipe,
    series: Sequence[WindSeries],
    *,
    seed: int = 0,
    progress: Callable[[Epoch], None] | None = None,
    checkpoint: Path | None = None,
) -> Model:
    """Train a model on several series of one step, with their faults masked.

    The end of each series trains nothing: it stops the training and calibrates the quantiles.

    Raises
    ------
    InvalidInput
        If the steps differ, or a series is too short to be split into training and validation.
    """
    if not series:
        raise InvalidInput("series", "to be one at least", "none")
    step = series[0].step
    if any(one.step != step for one in series):
        raise InvalidInput("series", "of one step", [str(one.step) for one in series])
    way = TARGETS[recipe.target]
    pairs = [chronological_split(without_faults(one), recipe.validation) for one in series]
    early, late = ([_found(part, recipe) for part in parts] for parts in zip(*pairs, strict=True))
    early = [replace(some, start=some.start[:: recipe.stride]) for some in early]
    scaling, spread = _scaling(way, early)
    examples = _examples(way, early, scaling)
    learn = partial(
        train,
        examples=examples,
        validation=_examples(way, late, scaling),
        loss=_loss(way, spread),
        scale=torch.from_numpy(scaling.outputs),
        centre=examples.y.mean(dim=0)[:, list(way.columns)],
        mirror=way.mirror,
        seed=seed,
        progress=progress,
    )
    weights = _in_two_phases(recipe, _shape(recipe, scaling), learn, checkpoint)
    uncalibrated = Model(
        recipe.target,
        step,
        recipe.history,
        recipe.horizon,
        weights,
        scaling,
        Calibration.none(),
    )
    return calibrated(uncalibrated, late)


def _in_two_phases(
    recipe: Recipe, shape: Shape, learn: Callable[..., Weights], checkpoint: Path | None
) -> Weights | QuantisedWeights:
    """Train in floating point, go on with the weights on their levels, and keep them there."""
    floats = replace(shape, bits=FLOAT, output_bits=FLOAT)
    first = checkpoint and checkpoint.with_suffix(".first")
    start = learn(floats, schedule=recipe.schedule, checkpoint=first)
    raw = learn(shape, schedule=recipe.refinement, checkpoint=checkpoint, start=start)
    bits = (shape.bits, shape.output_bits)
    rounding = raw.rounded if FLOAT in bits else raw.quantised
    return rounding(*bits, levels=recipe.levels, gamma=recipe.gamma)


def _shape(recipe: Recipe, scaling: Scaling) -> Shape:
    return Shape(
        len(scaling.mean),
        scaling.outputs.size,
        recipe.units,
        recipe.bits,
        recipe.output_bits or recipe.bits,
        recipe.levels,
        recipe.gamma,
    )


def calibrated(model: Model, found: Sequence[Windows]) -> Model:
    """Return ``model`` with its quantiles calibrated on windows that did not train it."""
    network = FloatNetwork(model.float_weights)
    plain = model.with_calibration(Calibration.none())

    def cases() -> Iterator[tuple[Traces, Traces, Traces]]:
        for some in found:
            for block in some.blocks():
                past = block.past
                yield plain.forecast(network, past), past, block.future

    return plain.with_calibration(calibrate(cases()))


def _found(series: WindSeries, recipe: Recipe) -> Windows:
    return windows(series, history=recipe.history, horizon=recipe.horizon)


def _loss(way: Target, spread: np.ndarray[tuple[int, ...], np.dtype[np.float32]]) -> Loss:
    """Return the loss of a target whose truths spread by ``spread``."""
    return residual_loss(torch.from_numpy(spread)) if isinstance(way, ResidualTarget) else raw_loss


def _scaling(
    way: Target, found: Sequence[Windows]
) -> tuple[Scaling, np.ndarray[tuple[int, ...], np.dtype[np.float32]]]:
    """Standardise inputs, and let outputs count the spread of what they should be."""
    x = np.concatenate([way.encode(some.past) for some in found])
    y = np.concatenate([way.truth(some.past, some.future) for some in found])
    spread = y.std(axis=0) + 1e-6
    columns = way.columns
    mean, deviation = x.mean(axis=(0, 1)), x.std(axis=(0, 1)) + 1e-3
    mean[list(way.mirror[0])] = 0.0  # as it is, of windows and their mirror images
    return Scaling(mean, deviation, np.ascontiguousarray(spread[:, columns])), spread


def _examples(way: Target, found: Sequence[Windows], scaling: Scaling) -> Examples:
    measured = np.concatenate([way.encode(some.past) for some in found])
    truth = np.concatenate([way.truth(some.past, some.future) for some in found])
    x = (measured - scaling.mean) / scaling.deviation
    return Examples(
        torch.from_numpy(x), torch.from_numpy(truth), torch.from_numpy(measured[:, -1:])
    )
