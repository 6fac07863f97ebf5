"""Flights and the arcs they fly: read off a solution, and written as one."""

import numpy as np
from numpy.typing import NDArray


def flights(x: NDArray[np.float64]) -> list[tuple[int, ...]]:
    """Return the flights that ``x`` chooses, each as its turbines in flying order, from 0.

    Parameters
    ----------
    x
        1 on the arcs that are flown, 0 elsewhere, shape ``(n + 1, n + 1)``; node 0 is the
        station, node i the turbine i - 1. Every turbine is left as often as it is reached.
    """
    follower = x[:, 1:].argmax(axis=1)  # Turbine that comes next, where one does.
    found = []
    for first in np.flatnonzero(x[0, 1:] > 0.5):
        flight = [int(first)]
        while x[flight[-1] + 1, 0] < 0.5:
            flight.append(int(follower[flight[-1] + 1]))
        found.append(tuple(flight))
    return found


def arcs_of(flight: tuple[int, ...], n: int) -> NDArray[np.bool_]:
    """Return the arcs that a flight chooses, shape ``(n + 1, n + 1)``.

    Parameters
    ----------
    flight
        Its turbines in flying order, from 0.
    n
        Number of turbines.
    """
    x = np.zeros((n + 1, n + 1), dtype=bool)
    nodes = [0, *(i + 1 for i in flight), 0]
    x[nodes[:-1], nodes[1:]] = True
    return x
