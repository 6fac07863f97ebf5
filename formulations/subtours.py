r"""Separation of subtours: the sets of turbines that a solution cuts off from the station.

A flight starts and ends at node 0, so into every set of turbines flies at least one unit of
:math:`x`:

.. math:: \sum_{i \notin S} \sum_{j \in S} x_{ij} \ge 1, \qquad S \subseteq V \setminus 0  \tag{1}

where each turbine is left as often as it is reached, which makes (1) the same as
:math:`\sum_{i,j \in S} x_{ij} \le |S| - 1`. There are :math:`2^n - 1` such rows, so a program
starts with none of them and is given those that its solution violates. The :math:`S` with the
least flow into it that contains a given node is a minimum cut between node 0 and that node,
which makes the search exact for fractional :math:`x` too (Padberg & Rinaldi 1990, *Math.
Programming* 47, 19-36).
"""

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components, maximum_flow

SCALE = 10**6  # SciPy's flows are integers.

Nodes: TypeAlias = tuple[int, ...]


def violated_sets(x: NDArray[np.float64], tol: float = 1e-4) -> Iterator[Nodes]:
    """Yield sets of nodes, without node 0, into which less than one unit of ``x`` flows.

    Nothing is yielded where no row (1) is violated. Nodes of a set that was found are not
    searched again, so the sets are few and mostly disjoint.

    Parameters
    ----------
    x
        Use of each arc, fractional or not, shape ``(n + 1, n + 1)``; where there are several
        stations or routes, their sum, with every station merged into node 0.
    tol
        Violation below which a row counts as kept.
    """
    capacity = csr_array(np.rint(SCALE * np.clip(x, 0.0, 1.0)).astype(np.int32))
    _, component = connected_components(capacity, directed=False)
    for c in np.unique(component[component != component[0]]):
        yield tuple(np.flatnonzero(component == c).tolist())

    if np.array_equal(x, np.rint(x)):
        return  # Whole arcs that reach the station's component pass through the station.
    unsearched = component == component[0]
    unsearched[0] = False
    while unsearched.any():
        v = int(unsearched.argmax())
        unsearched[v] = False
        cut = maximum_flow(capacity, 0, v)
        if cut.flow_value < (1.0 - tol) * SCALE:
            S = sink_side(csr_array(capacity - cut.flow), v)
            unsearched[list(S)] = False
            yield S


def inflow_row(
    x: HighspyArray, S: Nodes, flown: NDArray[np.bool_], least: int = 1
) -> highs_linear_expression:
    """Return the row (1) of ``S``, in whichever of its two forms has fewer terms.

    Parameters
    ----------
    x
        Variables of all arcs, shape ``(..., n + 1, n + 1)``; those of several stations or routes
        are summed.
    S
        Nodes other than 0.
    flown
        Arcs that take part, of the shape of ``x``.
    least
        How much flows into S at least.
    """
    within = np.isin(np.arange(x.shape[-1]), S)
    inside = flown & within[:, None] & within
    into = flown & ~within[:, None] & within
    if np.count_nonzero(inside) <= np.count_nonzero(into):
        return x[inside].sum() <= len(S) - least
    return x[into].sum() >= least


def sink_side(residual: csr_array, v: int) -> Nodes:
    """Return the nodes from which ``v`` can still be reached."""
    residual.eliminate_zeros()
    nodes = breadth_first_order(csr_array(residual.T), v, return_predecessors=False)
    return tuple(sorted(nodes.tolist()))
