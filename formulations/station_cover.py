r"""Station cover: the fewest sites from which every turbine is within reach.

Site j of a list of candidates, :math:`j = 1, \dots, m`, reaches turbine i or does not, in every
wind at once: :math:`a_{ji} \in \{0, 1\}`. :math:`x_j` says whether there is a station at j.

.. math::

    \min_x \quad & \sum_j x_j                                                   \tag{1} \\
    \text{s.t.} \quad & \sum_j a_{ji} x_j \ge 1 & i = 1, \dots, n                \tag{2} \\
      & x_j \in \{0, 1\}                                                        \tag{3}

This is location set covering [1]. It has many optima, among which
:mod:`formulations.station_median` chooses.

* [1] Toregas, Swain, ReVelle & Bergman (1971), *Operations Research* 19, 1363-1373.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import NDArray
from scipy.sparse import csr_array

from formulations.rows import add_rows, columns


@dataclass(frozen=True)
class StationCover:
    """The program, whole, and the sites it chooses."""

    model: highspy.Highs
    x: HighspyArray  # (m,)

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield nothing: no row is left out."""
        return iter(())


def station_cover(a: NDArray[np.bool_]) -> StationCover:
    """Build the program (1)-(3).

    Parameters
    ----------
    a
        Whether site j reaches turbine i in every wind, shape ``(m, n)``; no plan exists where no
        site reaches a turbine.
    """
    model = highspy.Highs()
    model.silent()
    m = len(a)

    x = model.addBinaries(m)  # (3)

    add_rows(model, (csr_array(a.T.astype(float)), x), lower=1.0)  # (2)

    model.changeColsCost(m, columns(x), np.ones(m))  # (1)
    return StationCover(model, x)
