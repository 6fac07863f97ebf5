"""The training loop: Adam with one cycle of the learning rate, stopped early, resumable."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from pickle import PickleError
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from windopt.errors import InvalidInput
from windopt.forecasting.network import Weights
from windopt.forecasting.training.losses import Loss
from windopt.forecasting.training.module import LstmModule, Shape

Mirror = tuple[tuple[int, ...], tuple[int, ...]]  # see windopt.forecasting.targets.Target

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class Schedule:
    """How long and how fast to train.

    Parameters
    ----------
    epochs
        Passes over the training windows at most.
    patience
        Passes without a better validation loss after which to stop.
    batch
        Windows in one step.
    rate
        Largest learning rate [-].
    """

    epochs: int = 20
    patience: int = 6
    batch: int = 256
    rate: float = 3e-3

    def __post_init__(self) -> None:
        for name in "epochs", "patience", "batch", "rate":
            if getattr(self, name) <= 0:
                raise InvalidInput(name, "> 0", getattr(self, name))


@dataclass(frozen=True)
class Epoch:
    """One pass over the training windows.

    Parameters
    ----------
    number
        Counted from 1.
    loss, validation_loss
        Mean over the training and the validation windows [-].
    best
        Whether no earlier pass had a smaller validation loss.
    bits
        Of the weights: training ends with a second count of passes, on the levels.
    """

    number: int
    loss: float
    validation_loss: float
    best: bool
    bits: int


@dataclass(frozen=True)
class Examples:
    """Windows as the network sees them: inputs ``(B, L, d)``, truth, and inputs as measured."""

    x: Tensor
    y: Tensor
    measured: Tensor

    def __len__(self) -> int:
        return len(self.x)

    def at(self, rows: Tensor) -> "Examples":
        """Return the examples ``rows``."""
        return Examples(self.x[rows], self.y[rows], self.measured[rows])

    def mirrored(self, mirror: Mirror, generator: torch.Generator) -> "Examples":
        """Exchange left and right in half of the examples, chosen at random.

        Turning air knows hardly more of left than of right: this doubles what there is to learn.
        """
        exchanged = torch.rand((len(self), 1, 1), generator=generator) < 0.5
        x, y = self.x.clone(), self.y.clone()
        for part, columns in zip((x, y), mirror, strict=True):
            for k in columns:
                part[..., k] = torch.where(exchanged[..., 0], -part[..., k], part[..., k])
        return Examples(x, y, self.measured)


def train(
    shape: Shape,
    examples: Examples,
    validation: Examples,
    loss: Loss,
    *,
    scale: Tensor,
    centre: Tensor,
    mirror: Mirror = ((), ()),
    schedule: Schedule,
    seed: int,
    start: Weights | None = None,
    progress: Callable[[Epoch], None] | None = None,
    checkpoint: Path | None = None,
) -> Weights:
    """Return the raw weights of the epoch with the smallest validation loss.

    Parameters
    ----------
    scale
        What the network's outputs count, shape ``(H, k)``.
    centre
        What they should be on average, where training begins, same shape.
    mirror
        Inputs and truths that change sign when left and right are exchanged.
    start
        Weights to begin with; random ones if left out.
    progress
        Called after each epoch.
    checkpoint
        A file that keeps the state after each epoch; training goes on from it where it exists.
    """
    torch.manual_seed(seed)
    module = LstmModule(shape)
    module.begin_at(centre / scale)
    if start is not None:
        module.begin_with(start)
    steps = max(1, len(examples) // schedule.batch)
    optimiser = torch.optim.Adam([p for p in module.parameters() if p.requires_grad])
    rate = torch.optim.lr_scheduler.OneCycleLR(
        optimiser, schedule.rate, total_steps=schedule.epochs * steps + 1
    )
    state = _State(module, optimiser, rate, shape.bits)
    if checkpoint is not None and checkpoint.exists():
        state.load(checkpoint)

    def error(some: Examples) -> Tensor:
        outputs = module(some.x).reshape(len(some), *scale.shape) * scale
        return loss(outputs, some.y, some.measured)

    for number in range(state.epoch + 1, schedule.epochs + 1):
        if number - state.best_epoch > schedule.patience and state.best_epoch:
            logger.info("no better validation loss since epoch %d", state.best_epoch)
            break
        draws = torch.Generator().manual_seed(1000 * seed + number)
        order = torch.randperm(len(examples), generator=draws)
        total = 0.0
        for rows in order[: steps * schedule.batch].chunk(steps):
            total += state.descend(error(examples.at(rows).mirrored(mirror, draws)))
        epoch = state.record(number, total / steps, _mean(error, validation))
        if checkpoint is not None:
            state.save(checkpoint)
        if progress is not None:
            progress(epoch)
    return state.best_weights()


def _mean(error: Callable[[Examples], Tensor], examples: Examples) -> float:
    """Mean error over the examples, some at a time."""
    with torch.no_grad():
        parts = torch.split(torch.arange(len(examples)), 8192)
        losses = [error(examples.at(rows)).item() * len(rows) for rows in parts]
    return sum(losses) / len(examples)


class _State:
    """What a training that was interrupted goes on from."""

    def __init__(self, module: LstmModule, optimiser: Any, rate: Any, bits: int) -> None:
        self.module, self.optimiser, self.rate, self.bits = module, optimiser, rate, bits
        self.epoch, self.best_epoch, self.best_loss = 0, 0, float("inf")
        self.best: dict[str, Tensor] = {}

    def descend(self, value: Tensor) -> float:
        """Take one step down from a loss, and return it."""
        self.optimiser.zero_grad()
        value.backward()  # type: ignore[no-untyped-call]
        nn.utils.clip_grad_norm_(self.module.parameters(), 1.0)
        self.optimiser.step()
        self.rate.step()
        return value.item()

    def record(self, number: int, loss: float, validation_loss: float) -> Epoch:
        """Note the end of an epoch, and keep the weights if they are the best."""
        self.epoch = number
        if better := bool(np.isfinite(validation_loss)) and validation_loss < self.best_loss:
            self.best_epoch, self.best_loss = number, validation_loss
            self.best = {name: value.clone() for name, value in self.module.state_dict().items()}
        return Epoch(number, loss, validation_loss, better, self.bits)

    def best_weights(self) -> Weights:
        """Return the raw weights of the best epoch."""
        if not self.best:
            raise InvalidInput("training", "to reach a finite validation loss", "none")
        self.module.load_state_dict(self.best)
        return self.module.raw_weights()

    def save(self, path: Path) -> None:
        """Write the state, whole or not at all."""
        parts = {name: getattr(self, name).state_dict() for name in ("module", "optimiser", "rate")}
        counts = {"epoch": self.epoch, "best_epoch": self.best_epoch, "best_loss": self.best_loss}
        unfinished = path.with_suffix(".part")
        torch.save({**parts, **counts, "best": self.best}, unfinished)
        unfinished.replace(path)

    def load(self, path: Path) -> None:
        """Read a state that :meth:`save` wrote.

        Raises
        ------
        InvalidInput
            If the file is damaged, or of another network.
        """
        try:
            saved = torch.load(path, weights_only=True)
            for name in "module", "optimiser", "rate":
                getattr(self, name).load_state_dict(saved[name])
            self.epoch, self.best = saved["epoch"], saved["best"]
            self.best_epoch, self.best_loss = saved["best_epoch"], saved["best_loss"]
        except (
            OSError,
            RuntimeError,
            ValueError,
            KeyError,
            TypeError,
            EOFError,
            PickleError,
        ) as no:
            raise InvalidInput("checkpoint", "of this training", f"{path.name}: {no}") from no
