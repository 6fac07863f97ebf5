r"""The arcs of a routing program: how long each takes, and which fit into a flight at all.

Every station d has its own copy of the nodes, 0 for itself and i for the turbine i - 1, because
its UAV may fly at another speed, for another time or to other turbines than the rest.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import ArrayLike, NDArray

from formulations.flights import arcs_of, flights

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
    shortest
        Least time from leaving i until done at j, over any turbines between them [fractions of
        the longest flight], shape ``(k, n + 1, n + 1)``; no less than ``tau`` unless that breaks
        the triangle inequality.
    flown
        Arcs on at least one way out and back that is short enough, shape ``(k, n + 1, n + 1)``.
    """

    t: NDArray[np.float64]
    tau: NDArray[np.float64]
    shortest: NDArray[np.float64]
    flown: NDArray[np.bool_]

    @property
    def alpha(self) -> NDArray[np.float64]:
        """Least time from the station until done at i [of the longest], ``(k, n + 1)``."""
        return self.shortest[:, 0, :]

    @property
    def omega(self) -> NDArray[np.float64]:
        """Least time from i back to the station [of the longest], ``(k, n + 1)``."""
        return self.shortest[:, :, 0]

    @property
    def alone(self) -> NDArray[np.float64]:
        """Each turbine on a flight of its own from the station that is back first, as arcs.

        A turbine that no station serves alone is left out.
        """
        x = np.zeros_like(self.t)
        tau = self.tau[:, 0, 1:] + self.tau[:, 1:, 0]
        seconds = np.where(tau <= 1.0 + ROUNDING, self.t[:, 0, 1:] + self.t[:, 1:, 0], np.inf)
        i = np.flatnonzero(np.isfinite(seconds).any(axis=0))
        d = seconds[:, i].argmin(axis=0)
        x[d, 0, i + 1] = x[d, i + 1, 0] = 1.0
        return x

    def long_flights(
        self, x: HighspyArray, values: NDArray[np.float64], station: Sequence[int]
    ) -> Iterator[highs_linear_expression]:
        """Yield the row against each flight that exceeds the longest: not all of its arcs.

        Parameters
        ----------
        x
            Variables of the arcs of each station or route, shape ``(m, n + 1, n + 1)``.
        values
            Their values, 0 or 1 and free of subtours.
        station
            Station of each, shape ``(m,)``.
        """
        for r, d in enumerate(station):
            for flight in flights(values[r]):
                P = arcs_of(flight, x.shape[-1] - 1)
                if self.tau[d][P].sum() > 1.0 + ROUNDING:
                    yield x[r][P].sum() <= int(P.sum()) - 1


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
        If the shapes do not fit each other, there is no turbine, a time is negative or missing,
        or a longest flight is not positive.
    """
    t = np.array(t, dtype=float, ndmin=3)
    k, n = len(t), t.shape[1] - 1
    if t.shape != (k, n + 1, n + 1):
        raise ValueError(f"Expected t of shape (k, n + 1, n + 1), got {t.shape}.")
    if n < 1:
        raise ValueError("Expected at least one turbine, got none.")
    if not (t >= 0.0).all():
        raise ValueError("Expected t >= 0, got a negative or missing time.")
    longest = np.broadcast_to(np.asarray(t_max, dtype=float), k)
    if not (longest > 0.0).all():
        raise ValueError(f"Expected t_max > 0, got {longest.min()}.")

    tau = t / longest[:, None, None]
    if allowed is not None:
        served = np.pad(allowed, ((0, 0), (1, 0)), constant_values=True)
        tau[~(served[:, :, None] & served[:, None, :])] = np.inf
    shortest = _shortest(tau)
    flown = shortest[:, 0, :, None] + tau + shortest[:, None, :, 0] <= 1.0 + ROUNDING
    flown &= ~np.eye(n + 1, dtype=bool)
    return Network(t, tau, shortest, flown)


def _shortest(tau: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the lengths of the shortest paths, through turbines only (Floyd & Warshall)."""
    least = tau.copy()
    least[:, range(tau.shape[1]), range(tau.shape[1])] = 0.0
    for v in range(1, tau.shape[1]):
        np.minimum(least, least[:, :, v, None] + least[:, v, None, :], out=least)
    return least
