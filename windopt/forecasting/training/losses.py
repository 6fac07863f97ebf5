"""Losses: mean absolute errors, and pinball losses where a quantile is learnt."""

from collections.abc import Callable

import torch
from torch import Tensor

from windopt.forecasting.targets import LEVELS, SPEED_MIN

Loss = Callable[[Tensor, Tensor, Tensor], Tensor]  # outputs (B, H, k), truth (B, H, .), inputs

OUTER = tuple(level for level in LEVELS if level != 0.5)


def pinball(quantiles: Tensor, truth: Tensor, levels: tuple[float, ...]) -> Tensor:
    """Mean pinball loss of ``quantiles`` ``(..., Q)`` for ``truth`` ``(...)``.

    Half the absolute error at the median; smallest, at each level, for that quantile.
    """
    p = torch.tensor(levels, dtype=truth.dtype)
    excess = truth[..., None] - quantiles
    return torch.maximum(p * excess, (p - 1) * excess).mean()


def raw_loss(outputs: Tensor, truth: Tensor, inputs: Tensor) -> Tensor:
    """Mean absolute error, the paper's loss."""
    return (outputs - truth).abs().mean()


def residual_loss(scale: Tensor) -> Loss:
    """Return the loss of :class:`windopt.forecasting.targets.ResidualTarget`.

    Parameters
    ----------
    scale
        Spread of each residual at each step ahead, shape ``(H, 4)``, so that steps and residuals
        weigh alike.

    The velocity counts little beside its angle, which is what is forecast with it.
    """

    def loss(outputs: Tensor, truth: Tensor, inputs: Tensor) -> Tensor:
        s, d = torch.expm1(inputs[:, -1:, 3]), torch.exp(inputs[:, -1:, 4])
        theta = torch.atan2(d * outputs[..., 1], s + SPEED_MIN + d * outputs[..., 0])
        turn = truth[..., 3] * d / (s + SPEED_MIN)
        off = torch.remainder(theta - turn + torch.pi, 2 * torch.pi) - torch.pi
        velocity = ((outputs[..., :2] - truth[..., :2]) / scale[:, :2]).abs().mean()
        direction = (off * (s + SPEED_MIN) / d / scale[:, 3]).abs().mean()
        unit = scale[..., None]
        speed = pinball(outputs[..., 2:7] / unit[:, 2], truth[..., 2] / scale[:, 2], LEVELS)
        spread = pinball(outputs[..., 7:] / unit[:, 3], truth[..., 3] / scale[:, 3], OUTER)
        return 0.05 * velocity + 0.6 * direction + 2.0 * speed + 1.5 * spread

    return loss
