"""Time stamps brought to one equal step, and the rows of the file that fill it."""

import numpy as np
from numpy.typing import NDArray

from windopt.domain.wind import Times
from windopt.errors import InvalidInput

Rows = NDArray[np.intp]
MAX_SPARSITY = 10
"""Steps per row beyond which a file is taken to have no step of its own."""


def in_order(time: Times, lines: Rows) -> bool:
    """Tell whether times increase, or raise unless they decrease throughout.

    Parameters
    ----------
    time
        As the file gives them.
    lines
        The line on which each stands.

    Raises
    ------
    InvalidInput
        Naming the line on which a time is repeated or turns back.
    """
    steps = np.diff(time) / np.timedelta64(1, "us")
    if (steps < 0).all():
        return False
    if (steps > 0).all():
        return True
    row = int(np.argmax(steps <= 0)) + 1
    verb = "repeats" if steps[row - 1] == 0 else "turns back"
    raise InvalidInput("time", "to increase from row to row", f"{verb} at line {lines[row]}")


def regular_steps(time: Times) -> tuple[Times, Rows, tuple[str, ...]]:
    """Return the times of the grid, the place of each row on it, and notes.

    The step is the most common one; where a clock trembles, so that few rows are a multiple of it
    apart, it is the median in whole minutes. Rows between two times of the grid move to the
    nearest; where two rows meet there, the later one stays.

    Parameters
    ----------
    time
        Increasing, shape ``(T,)``.

    Raises
    ------
    InvalidInput
        If the rows are too far apart for their step.
    """
    elapsed = time - time[0]
    step = _step(np.diff(time))
    place = np.rint(elapsed / step).astype(np.intp)
    length = int(place[-1]) + 1
    if length > MAX_SPARSITY * len(time):
        raise InvalidInput("time", "to have one step with few gaps", f"{len(time)} scattered rows")
    grid = time[0] + np.arange(length) * step

    notes = []
    filled = int(np.count_nonzero(np.diff(place))) + 1
    gaps, met = length - filled, len(place) - filled
    moved = int(np.count_nonzero(elapsed != place * step))
    if gaps:
        notes.append(f"Steps without a row, kept as missing values: {gaps} of {length}.")
    if moved:
        notes.append(f"Rows between two steps, moved to the nearest: {moved}.")
    if met:
        notes.append(f"Rows that share a step with a later one, left out: {met}.")
    return grid, place, tuple(notes)


def _step(apart: NDArray[np.timedelta64]) -> np.timedelta64:
    """Return the step of rows that are ``apart``."""
    steps, counts = np.unique(apart, return_counts=True)
    common: np.timedelta64 = steps[counts.argmax()]
    minutes = np.rint(np.median(apart / np.timedelta64(1, "m")))
    if minutes < 1 or 2 * counts[steps % common == np.timedelta64(0)].sum() > len(apart):
        return common
    return np.timedelta64(int(minutes), "m")
