r"""Nonlinear programs whose rows are sums of small, similar equations.

A farm has thousands of pairs of turbines, and each pair obeys the same few equations. A
:class:`Family` holds such equations once, as a function :math:`\phi(v, p)` of a few variables and
parameters, with the places of every member's variables and rows; the program is the sum of its
members,

.. math::

    \min f(x) = \sum_e \phi(x_e, p_e), \qquad
    \underline g_i \le g_i(x) = \sum_e \phi_i(x_e, p_e) \le \overline g_i.

First and second derivatives are those of :math:`\phi`, mapped over the members like its values and
scattered to where they belong: exact, as sparse as the program, and built in milliseconds. Left to
itself, CasADi would differentiate the whole sum once for every colour of its Jacobian.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Family:
    """Equations that hold for many members.

    Parameters
    ----------
    equations
        A CasADi function of SX, from the variables and parameters of a member to its terms.
    variables
        Places of each member's variables in x, shape ``(m, E)``.
    parameters
        Shape ``(q, E)``.
    rows
        The rows to which each member's terms are added, shape ``(r, E)``.
    """

    equations: ca.Function
    variables: Places
    parameters: Floats
    rows: Places

    @property
    def members(self) -> int:
        """How many there are."""
        return int(self.variables.shape[1])


class Derivatives(NamedTuple):
    """Nonzeros of a family's first and second derivatives, and their places in them."""

    first: ca.Function
    first_places: tuple[Places, Places]
    second: ca.Function
    second_places: tuple[Places, Places]


@lru_cache(maxsize=128)
def derivatives(equations: ca.Function) -> Derivatives:
    """Differentiate a family's equations, once for all programs they appear in."""
    v, p = equations.sx_in()
    terms = equations(v, p)
    weights = ca.SX.sym("weights", terms.shape[0])
    J = ca.jacobian(terms, v)
    H = ca.triu(ca.hessian(ca.dot(weights, terms), v)[0])
    first = ca.Function("first", [v, p], [ca.cse(J.nz[:])])
    second = ca.Function("second", [v, p, weights], [ca.cse(H.nz[:])])
    return Derivatives(first, _places(J), second, _places(H))


def _places(matrix: ca.SX) -> tuple[Places, Places]:
    rows, columns = matrix.sparsity().get_triplet()
    return np.array(rows, dtype=np.intp), np.array(columns, dtype=np.intp)


@dataclass(frozen=True, eq=False)
class SeparableProgram:
    """The program min f(x) with bounds on x and on the rows g(x).

    Parameters
    ----------
    objective
        Its terms, all of row 0, add up to f.
    constraints
        Their terms add up to g.
    lower_x, upper_x
        Bounds of the variables.
    lower_g, upper_g
        Bounds of the rows.
    """

    objective: Family
    constraints: Sequence[Family]
    lower_x: Floats
    upper_x: Floats
    lower_g: Floats
    upper_g: Floats

    @cached_property
    def x(self) -> ca.MX:
        """The variables, a symbol."""
        return ca.MX.sym("x", len(self.lower_x))

    @cached_property
    def f(self) -> ca.MX:
        """The objective."""
        return self._values([self.objective], 1)

    @cached_property
    def g(self) -> ca.MX:
        """The rows."""
        return self._values(self.constraints, len(self.lower_g))

    @cached_property
    def gradient(self) -> ca.MX:
        """The gradient of f."""
        return ca.densify(self._slopes([self.objective], 1)).T

    @cached_property
    def jacobian(self) -> ca.MX:
        """The Jacobian of g."""
        return self._slopes(self.constraints, len(self.lower_g))

    def hessian(self, sigma: ca.MX, lam: ca.MX) -> ca.MX:
        """Return the upper triangle of the Hessian of sigma f + lam g."""
        nonzeros, rows, columns = [], [], []
        for family, weights in [(self.objective, sigma), *((c, lam) for c in self.constraints)]:
            d = derivatives(family.equations)
            r, c = (family.variables[place] for place in d.second_places)
            if not r.size:
                continue
            of_terms = ca.reshape(weights[family.rows.ravel(order="F").tolist()], family.rows.shape)
            second = d.second.map(family.members)(*self._members(family), of_terms)
            nonzeros.append(ca.vec(second))
            rows.append(np.minimum(r, c).ravel(order="F"))
            columns.append(np.maximum(r, c).ravel(order="F"))
        n = len(self.lower_x)
        return _scattered(nonzeros, rows, columns, (n, n))

    def _values(self, families: Sequence[Family], m: int) -> ca.MX:
        total = ca.MX(ca.DM.zeros(m))
        for family in families:
            if family.members:
                terms = family.equations.map(family.members)(*self._members(family))
                total += _sums(family.rows.ravel(order="F"), m) @ ca.vec(terms)
        return total

    def _slopes(self, families: Sequence[Family], m: int) -> ca.MX:
        nonzeros, rows, columns = [], [], []
        for family in families:
            if family.members:
                d = derivatives(family.equations)
                r, c = d.first_places
                first = d.first.map(family.members)(*self._members(family))
                nonzeros.append(ca.vec(first))
                rows.append(family.rows[r].ravel(order="F"))
                columns.append(family.variables[c].ravel(order="F"))
        return _scattered(nonzeros, rows, columns, (m, len(self.lower_x)))

    def _members(self, family: Family) -> tuple[ca.MX, ca.DM]:
        places = family.variables.ravel(order="F").tolist()
        return ca.reshape(self.x[places], family.variables.shape), ca.DM(family.parameters)


def _sums(rows: Places, n: int) -> ca.DM:
    """Return the matrix that adds terms to their rows."""
    T = len(rows)
    pattern = ca.Sparsity.triplet(n, T, rows.tolist(), list(range(T)))
    return ca.DM(pattern, np.ones(T))


def _scattered(
    nonzeros: list[ca.MX], rows: list[Places], columns: list[Places], shape: tuple[int, int]
) -> ca.MX:
    """Return the sparse matrix whose entries at the same place are added."""
    if not nonzeros:
        return ca.MX(*shape)
    i, j = np.concatenate(rows), np.concatenate(columns)
    places, entry = np.unique(j * shape[0] + i, return_inverse=True)
    pattern = ca.Sparsity.triplet(
        *shape, (places % shape[0]).tolist(), (places // shape[0]).tolist()
    )
    return ca.MX(pattern, _sums(entry, len(places)) @ ca.vertcat(*nonzeros))
