"""Parities: flights made in two threads that never meet.

Every other turbine is marked, and the parity of a flight is that of the number of these it visits,
the sum of its halves' parities. Flights of either parity are made apart, of pairs of halves that
are tried for this parity only, and no set of turbines has both.
"""

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.half_flights import Halves

Parities = NDArray[np.uint8]

MARKED = np.uint64(0x5555555555555555)
"""The marked turbines of each word."""


def parities(halves: Halves) -> Parities:
    """Return 1 for each half that visits an odd number of marked turbines, 0 for the others."""
    found: Parities = np.bitwise_count(halves.set & MARKED).sum(axis=1, dtype=np.uint8) & 1
    return found


def grouped(
    halves: Halves, parity: Parities, n: int, buckets: int, width: float
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sort halves, even ones first, by turbine, time bucket and cost.

    Parameters
    ----------
    buckets, width
        Number of time buckets, and width of one.

    Returns
    -------
    The order, and where each group of one parity, turbine and bucket begins.
    """
    bucket = (halves.T / width).astype(np.int64)
    group = (parity.astype(np.int64) * n + halves.node) * buckets + bucket
    order = np.lexsort((halves.C, group))
    begin = np.searchsorted(group[order], np.arange(2 * n * buckets + 1))
    return order, begin.astype(np.int64)
