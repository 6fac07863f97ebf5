"""Waiting labels: what is found but not compared yet, and the room that all labels share."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints, Labels, Words
from windopt.solving.exact.network import Floats

LAYERS = 8
"""Layers of each time bucket, on average, at most."""


class Span(NamedTuple):
    """How long labels fly.

    Attributes
    ----------
    t_max, horizon
        Longest flight, and longest time of a label.
    width
        Width of a time bucket.
    """

    t_max: float
    horizon: float
    width: float


class Waiting(NamedTuple):
    """Labels found but not compared yet: a linked list for each bucket and turbine.

    Attributes
    ----------
    T, C, V, S, parent
        As of :class:`~windopt.solving.exact.labels.Labels`.
    checked
        Last layer that a label was compared with.
    following, head
        Next label of a list, and the first, shape ``(buckets, n)``; -1 at the end.
    number
        Labels waiting in each bucket.
    row
        The first row that was given back, or -1, and the first that was never used.
    """

    T: Floats
    C: Floats
    V: Words
    S: Words
    parent: Ints
    checked: Ints
    following: Ints
    head: Ints
    number: NDArray[np.int64]
    row: NDArray[np.int64]


@compiled
def empty_labels(capacity: int, shape: tuple[int, int], span: Span) -> tuple[Labels, Waiting]:
    """Make room for ``capacity`` labels, and for one of each turbine at least.

    Parameters
    ----------
    shape
        Number of turbines, and of words that the parities of cuts take.
    """
    n, words = shape
    capacity = max(capacity, n)
    buckets = int(span.horizon / span.width) + 1
    layers = LAYERS * buckets + 1
    found = Labels(
        np.empty(capacity),
        np.empty(capacity),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.uint64),
        np.empty((capacity, words), np.uint64),
        np.zeros((layers, n), np.int32),
        np.zeros((layers, n), np.int32),
        np.empty(layers),
    )
    waiting = Waiting(
        np.empty(capacity),
        np.empty(capacity),
        np.empty(capacity, np.uint64),
        np.empty((capacity, words), np.uint64),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.empty(capacity, np.int32),
        np.full((buckets, n), -1, np.int32),
        np.zeros(buckets, np.int64),
        np.array([-1, 0]),
    )
    return found, waiting


@compiled
def enlist(waiting: Waiting, new: int, b: int, j: int) -> None:
    """Let the label in row ``new`` wait at turbine j in bucket b."""
    if new == waiting.row[0]:
        waiting.row[0] = waiting.following[new]
    else:
        waiting.row[1] += 1
    waiting.following[new], waiting.head[b, j] = waiting.head[b, j], new
    waiting.number[b] += 1


@compiled
def in_use(found: Labels, count: int, layers: int) -> Labels:
    """Return copies of the rows in use."""
    return Labels(
        found.T[:count].copy(),
        found.C[:count].copy(),
        found.node[:count].copy(),
        found.parent[:count].copy(),
        found.V[:count].copy(),
        found.S[:count].copy(),
        found.start[:layers].copy(),
        found.end[:layers].copy(),
        found.opens[:layers].copy(),
    )
