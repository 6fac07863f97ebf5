"""Screening: flights left out of a list by the prices of the list before.

Prices bound plans however they were found: a plan takes their value and the reduced costs of its
flights. Where these fall below zero by little, a plan cheaper than a target flies only flights
whose reduced cost is at most what is left up to the target, and that little. The prices of a list
count its rows in full, which labels cannot afford, and leave out most flights that the prices of
labels let pass; those left out are made and looked at one by one, but never held.

No list tells how far flights beyond it fall below zero by its prices. A mix with the prices of
labels, by which none does, keeps them above it, or not much below. By how much those of one plan
fall is seen in the new list, which holds all that do; if a plan may then cost more than the list
allowed for, the list is made again.
"""

from dataclasses import dataclass

import numpy as np

from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.row_duals import RowDuals


@dataclass(frozen=True)
class Screen:
    """Prices, and the reduced cost by these that flights of interest do not exceed.

    Parameters
    ----------
    prices
        Any duals and rows; flights may fall below zero by them.
    limit
        Of the reduced cost, not negative.

    Raises
    ------
    ValueError
        If ``limit`` is negative: then flights below zero would be left out, and not be seen.
    """

    prices: RowDuals
    limit: float

    def __post_init__(self) -> None:
        if not self.limit >= 0.0:
            raise ValueError(f"Expected limit >= 0, got {self.limit}.")


def together_below(reduced: Floats, members: Bools) -> float:
    """Return how far flights of one plan fall below zero together, at most.

    What a flight falls short of is shared equally among its turbines; a plan visits each once, so
    a turbine adds no more than its largest share.

    Parameters
    ----------
    reduced
        All reduced costs below zero, shape ``(m,)``.
    members
        Whether each flight visits each turbine, shape ``(m, n)``.
    """
    parts = -reduced / members.sum(axis=1)
    return float(sum(parts[visiting].max(initial=0.0) for visiting in np.asarray(members).T))
