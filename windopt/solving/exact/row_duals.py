"""Duals of rows that count in full, as they do over a list of flights without cycles."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from windopt.solving.exact.master import Duals
from windopt.solving.exact.rank_one_rows import Rows
from windopt.solving.exact.subset_row_cuts import Path


class RowDuals(NamedTuple):
    """Duals, and the row of each penalty."""

    duals: Duals
    rows: Rows

    def without_small(self, least: float) -> "RowDuals":
        """Return the same duals of the rows whose penalty is larger than ``least``."""
        keep = self.duals.penalty > least
        return RowDuals(replace(self.duals, penalty=self.duals.penalty[keep]), self.rows.kept(keep))

    def reduced_cost(self, station: int, path: Path, time: float) -> float:
        """Return the reduced cost of a flight without cycles.

        Rows are counted in full, and crowded sets once however often they are entered.
        """
        duals, members = self.duals, np.zeros((1, len(self.duals.pi)), bool)
        members[0, list(path)] = True
        entered = duals.reward[(duals.crowded.sets & members).any(axis=1)].sum()
        penalty = self.rows.coefficients(members)[0] @ duals.penalty
        return float(time - duals.pi[list(path)].sum() - duals.toll[station] - entered + penalty)


def mixed(share: float, one: RowDuals, other: RowDuals) -> RowDuals:
    """Return ``share`` of one and the rest of another.

    Reduced costs are the mix of theirs. So is the value, or larger where one pays for flights and
    the other is paid.
    """
    rest = 1.0 - share
    (a, rows), (b, other_rows) = one, other
    duals = Duals(
        share * a.pi + rest * b.pi,
        share * a.sigma + rest * b.sigma,
        np.concatenate([share * a.penalty, rest * b.penalty]),
        np.concatenate([share * a.reward, rest * b.reward]),
        a.crowded.joined(b.crowded),
    )
    return RowDuals(duals, rows.joined(other_rows))
