"""Quantisation while training: round on the way forward, not on the way back.

The rounding has a gradient of zero wherever it has one, and clipped weights would never move
again; so the gradient passes both unchanged (the straight-through estimator). The scale of each
matrix follows its median and is a constant on the way back.
"""

from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torch.nn.utils import parametrize

from windopt.forecasting.quantisation import FLOAT, Levels, quantise


class _OnLevels(torch.autograd.Function):
    @staticmethod
    def forward(
        ctx: Any, W: Tensor, bits: int, levels: Levels, gamma: float, blocks: int
    ) -> Tensor:
        parts = np.split(W.detach().numpy(), blocks)
        rounded = [quantise(part, bits, levels=levels, gamma=gamma).values for part in parts]
        return torch.from_numpy(np.concatenate(rounded))

    @staticmethod
    def backward(ctx: Any, gradient: Tensor) -> tuple[Tensor, None, None, None, None]:
        return gradient, None, None, None, None


class OnLevels(nn.Module):
    """A parametrisation that rounds a weight to its levels.

    Parameters
    ----------
    bits, levels, gamma
        Which levels, and how wide they span.
    blocks
        Number of matrices stacked in the weight, each with a scale of its own.
    """

    def __init__(self, bits: int, levels: Levels, gamma: float, blocks: int) -> None:
        super().__init__()
        self.bits, self.levels, self.gamma, self.blocks = bits, levels, gamma, blocks

    def forward(self, W: Tensor) -> Tensor:
        """Return ``W`` on its levels, with the gradient of ``W`` itself."""
        on_levels: Tensor = _OnLevels.apply(  # type: ignore[no-untyped-call]
            W, self.bits, self.levels, self.gamma, self.blocks
        )
        return on_levels


def quantise_while_training(
    module: nn.Module, name: str, bits: int, *, levels: Levels, gamma: float, blocks: int = 1
) -> None:
    """Let ``module`` use its weight ``name`` on the levels of ``bits`` bits; 32 leaves it alone."""
    if bits != FLOAT:
        # torch checks a parametrisation by calling it, which an LSTM's flat weights do not allow.
        parametrize.register_parametrization(
            module, name, OnLevels(bits, levels, gamma, blocks), unsafe=True
        )
