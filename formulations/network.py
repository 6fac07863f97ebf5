r"""The arcs of a routing program: how long each takes, and which fit into a flight at all.

Every station d has its own copy of the nodes, 0 for itself and i for the turbine i - 1, because
its UAV may fly at another speed, for another time or to other turbines than the rest.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

ROUNDING = 1e-9  # Fractions of t_max by which two sums of the same legs may differ.


@dataclass(frozen=True)
class Network:
    """Times of all legs, and what they say about flights.

    Parameters
    ----------
    t
        Time from leaving i until done at j [s], shape ``(k, n + 1, n + 1)``.
    tau
        The same as fractions of the longest flight [-].
    alpha, omega
        Least time from the station until done at i, and from there back [fractions of the
        longest flight], shape ``(k, n + 1)``.
    flown
        Arcs on at least one way out and back that is short enough, shape ``(k, n + 1, n + 1)``.
    """

    t: NDArray[np.float64]
    tau: NDArray[np.float64]
    alpha: NDArray[np.float64]
    omega: NDArray[np.float64]
    flown: NDArray[np.bool_]

    @property
    def alone(self) -> NDArray[np.float64]:
        """Each turbine on a flight of its own from the station that is back first, as arcs."""
        x = np.zeros_like(self.t)
        i = np.arange(1, self.t.shape[1])
        d = (self.t[:, 0, 1:] + self.t[:, 1:, 0]).argmin(axis=0)
        x[d, 0, i] = x[d, i, 0] = 1.0
        return x

    def too_long(self, d: int, legs: list[tuple[int, int]]) -> bool:
        """Whether the legs together exceed the longest flight of station d's UAV."""
        return bool(sum(self.tau[d, i, j] for i, j in legs) > 1.0 + ROUNDING)


def network(
    t: NDArray[np.float64], t_max: ArrayLike, allowed: NDArray[np.bool_] | None = None
) -> Network:
    """Return the arcs that ``t`` describes.

    Parameters
    ----------
    t
        Time from leaving i until done at j, inspection included [s], shape
        ``(k, n + 1, n + 1)``, or ``(n + 1, n + 1)`` for one station; ``inf`` where the leg cannot
        be flown.
    t_max
        Longest flight of each station's UAV [s], shape ``(k,)`` or one for all.
    allowed
        Whether station d may serve turbine i, shape ``(k, n)``; all by default.

    Raises
    ------
    ValueError
        If the shapes do not fit each other, a time is negative or missing, or a longest flight
        is not positive.
    """
    t = np.array(t, dtype=float, ndmin=3)
    k, n = len(t), t.shape[1] - 1
    if t.shape != (k, n + 1, n + 1):
        raise ValueError(f"Expected t of shape (k, n + 1, n + 1), got {t.shape}.")
    if not (t >= 0.0).all():
        raise ValueError("Expected t >= 0, got a negative or missing time.")
    longest = np.broadcast_to(np.asarray(t_max, dtype=float), k)
    if not (longest > 0.0).all():
        raise ValueError(f"Expected t_max > 0, got {longest.min()}.")

    tau = t / longest[:, None, None]
    if allowed is not None:
        served = np.pad(allowed, ((0, 0), (1, 0)), constant_values=True)
        tau[~(served[:, :, None] & served[:, None, :])] = np.inf
    alpha = _least_times(tau)
    omega = _least_times(tau.swapaxes(1, 2))
    flown = alpha[:, :, None] + tau + omega[:, None, :] <= 1.0 + ROUNDING
    flown &= ~np.eye(n + 1, dtype=bool)
    return Network(t, tau, alpha, omega, flown)


def _least_times(tau: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the length of the shortest path from node 0 to each node (Bellman & Ford)."""
    alpha = tau[:, 0, :].copy()
    alpha[:, 0] = 0.0
    while True:
        shorter = np.minimum(alpha, (alpha[:, :, None] + tau).min(axis=1))
        if np.array_equal(shorter, alpha):
            return alpha
        alpha = shorter
