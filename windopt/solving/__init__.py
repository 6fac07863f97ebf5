"""Turning programs into results: statuses, bounds, time limits and Ctrl-C end here."""

from typing import Any

from windopt.result import Result


def solve(program: Any, **options: Any) -> Result[Any]:
    """Solve a program of :mod:`formulations`, whatever its kind.

    Integer programs carry a HiGHS ``model`` and go to :func:`windopt.solving.integer.solve`; the
    others carry a CasADi ``opti`` and go to :func:`windopt.solving.nonlinear.solve`.

    Parameters
    ----------
    program
        What a function of :mod:`formulations` returned, with rows of your own or without.
    options
        Options of the solver, as documented there.
    """
    if hasattr(program, "model"):
        from windopt.solving import integer

        result: Result[Any] = integer.solve(program, **options)
    else:
        from windopt.solving import nonlinear

        result = nonlinear.solve(program, **options)
    return result
