r"""Station median: p stations from which the turbines are reached in the least total time.

:math:`t_{ji}` is the time of a round trip from site j to turbine i, finite on the pairs
:math:`R` where i is within reach of j. :math:`x_j` says whether there is a station at j, and
:math:`z_{ji}` whether it looks after turbine i.

.. math::

    \min_{x, z} \quad & \sum_{(j, i) \in R} t_{ji} z_{ji}                         \tag{1} \\
    \text{s.t.} \quad & \sum_j z_{ji} = 1 & i = 1, \dots, n                        \tag{2} \\
      & z_{ji} \le x_j & (j, i) \in R                                             \tag{3} \\
      & \sum_j x_j = p                                                            \tag{4} \\
      & x_j \in \{0, 1\}, \quad z_{ji} \ge 0                                      \tag{5}

This is the p-median of Hakimi as ReVelle & Swain write it [1], with the pairs beyond reach left
out. Given the stations, the best :math:`z` sends each turbine to the quickest, so it is whole by
itself; one row (3) for each pair keeps the relaxation close to the optimum.

* [1] ReVelle & Swain (1970), *Geographical Analysis* 2, 30-42.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import NDArray
from scipy.sparse import csr_array

from formulations.rows import Matrix, add_rows, columns

Ints = NDArray[np.intp]


@dataclass(frozen=True)
class StationMedian:
    """The program, whole, and the sites it chooses."""

    model: highspy.Highs
    x: HighspyArray  # (m,)
    z: HighspyArray  # one for each pair within reach

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield nothing: no row is left out."""
        return iter(())


def station_median(t: NDArray[np.float64], p: int) -> StationMedian:
    """Build the program (1)-(5).

    Parameters
    ----------
    t
        Time of the round trip from site j to turbine i [s], shape ``(m, n)``; ``inf`` beyond
        reach.
    p
        How many stations.
    """
    model = highspy.Highs()
    model.silent()
    m, n = t.shape
    j, i = np.nonzero(np.isfinite(t))
    pair = np.arange(len(j))

    x = model.addBinaries(m)  # (5)
    z = model.addVariables(len(pair))

    add_rows(model, (ones(i, pair, n), z), lower=1.0, upper=1.0)  # (2)
    add_rows(
        model, (ones(pair, pair, len(pair)), z), (-ones(pair, j, len(pair), m), x), upper=0.0
    )  # (3)
    model.addConstr(x.sum() == p)  # (4)

    model.changeColsCost(len(pair), columns(z), t[j, i])  # (1)
    return StationMedian(model, x, z)


def ones(row: Ints, column: Ints, m: int, n: int | None = None) -> Matrix:
    """Return the matrix with ones at the given places, shape ``(m, n)``; n is their number."""
    places = len(row)
    return csr_array((np.ones(places), (row, column)), shape=(m, places if n is None else n))
