"""Separable programs against CasADi's own derivatives of their sums."""

import casadi as ca
import numpy as np
import pytest

from formulations.separable import Family, SeparableProgram
from windopt.result import Status
from windopt.solving.separable import prepared, search


def members(terms, variables, parameters, rows):
    v, p = ca.SX.sym("v", len(variables)), ca.SX.sym("p", len(parameters))
    equations = ca.Function("equations", [v, p], [terms(v, p)])
    return Family(equations, np.array(variables), np.array(parameters), np.array(rows))


@pytest.fixture(scope="module")
def program():
    """Minimise the sum of (x_i - i)^2 subject to sums of products of neighbours."""
    n = 6
    i = np.arange(n)
    squares = members(lambda v, p: (v - p) ** 2, [i], [i.astype(float)], [0 * i])
    products = members(
        lambda v, p: ca.vertcat(p * v[0] * v[1], ca.sin(v[0]) + v[1] ** 3),
        [i[:-1], i[1:]],
        [np.ones(n - 1)],
        [i[:-1] // 2, 3 + i[:-1] % 2],
    )
    lower_g = np.array([-np.inf, -np.inf, -np.inf, 0.0, 0.0])
    upper_g = np.array([1.0, 2.0, 3.0, np.inf, np.inf])
    return SeparableProgram(
        squares, [products], np.full(n, -9.0), np.full(n, 9.0), lower_g, upper_g
    )


def test_derivatives_are_those_of_the_sums(program):
    sigma, lam = ca.MX.sym("sigma"), ca.MX.sym("lam", 5)
    lagrangian = sigma * program.f + ca.dot(lam, program.g)
    mapped = program.gradient, program.jacobian, program.hessian(sigma, lam)
    own = (
        ca.gradient(program.f, program.x),
        ca.jacobian(program.g, program.x),
        ca.triu(ca.hessian(lagrangian, program.x)[0]),
    )
    both = ca.Function("both", [program.x, sigma, lam], [*mapped, *own])
    rng = np.random.default_rng(0)
    values = [np.array(value) for value in both(rng.normal(size=6), 0.7, rng.normal(size=5))]
    for a, b in zip(values[:3], values[3:], strict=True):
        assert a == pytest.approx(b, abs=1e-12)


def test_terms_of_one_row_are_added(program):
    value = ca.Function("g", [program.x], [program.g])(np.ones(6))
    expected = 1 + np.sin(1)
    assert np.array(value).ravel() == pytest.approx([2, 2, 1, 3 * expected, 2 * expected])


def test_a_local_optimum_keeps_the_rows(program):
    found = search(prepared(program, time_limit=10.0), np.ones(6))
    g = np.array(ca.Function("g", [program.x], [program.g])(found.found())).ravel()
    assert found.status is Status.LOCALLY_OPTIMAL
    assert (g <= program.upper_g + 1e-6).all()
    assert (g >= program.lower_g - 1e-6).all()


def test_a_family_without_members_adds_nothing():
    none = members(
        lambda v, p: v * p, np.zeros((1, 0), int), np.zeros((1, 0)), np.zeros((1, 0), int)
    )
    one = members(lambda v, p: p * v**2, [[0]], [[1.0]], [[0]])
    program = SeparableProgram(one, [none], -np.ones(1), np.ones(1), np.zeros(0), np.zeros(0))
    assert search(prepared(program), np.array([0.5])).objective == pytest.approx(0.0, abs=1e-8)
