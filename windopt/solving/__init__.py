"""Turning programs into results: statuses, bounds, time limits and Ctrl-C end here."""

from typing import Any

from windopt.errors import InvalidInput
from windopt.result import Result


def solve(program: Any, *, time_limit: float = 60.0, **options: Any) -> Result[Any]:
    """Solve a program of :mod:`formulations`, whatever its kind.

    Integer programs carry a HiGHS ``model`` and go to :func:`windopt.solving.integer.solve`,
    separable ones carry ``constraints`` and go to :func:`windopt.solving.separable.solve`; the
    others carry a CasADi ``opti`` and go to :func:`windopt.solving.nonlinear.solve`.

    Parameters
    ----------
    program
        What a function of :mod:`formulations` returned, with rows of your own or without.
    time_limit
        Wall-clock limit [s].
    options
        Further options of the solver, as documented there.

    Raises
    ------
    InvalidInput
        If ``time_limit`` is negative or missing, or as the solver does.
    """
    if not time_limit >= 0.0:
        raise InvalidInput("time_limit", ">= 0", time_limit)
    if hasattr(program, "model"):
        from windopt.solving import integer

        result: Result[Any] = integer.solve(program, time_limit=time_limit, **options)
    elif hasattr(program, "constraints"):
        from windopt.solving import separable

        result = separable.solve(program, time_limit=time_limit, **options)
    else:
        from windopt.solving import nonlinear

        result = nonlinear.solve(program, time_limit=time_limit, **options)
    return result


def relax(program: Any, *, time_limit: float = 60.0) -> Result[Any]:
    """Solve the linear relaxation of an integer program of :mod:`formulations`.

    Parameters
    ----------
    program
        As for :func:`solve`; it stays as it is.
    time_limit
        Wall-clock limit [s].

    Returns
    -------
    Result
        Its value is the bound that the program as stated proves; its solution is fractional.

    Raises
    ------
    InvalidInput
        If ``time_limit`` is negative, or the program has no relaxation, being nonlinear.
    """
    if not hasattr(program, "model"):
        raise InvalidInput("program", "to be an integer program", type(program).__name__)
    from windopt.solving import relaxed

    return relaxed.relax(program, time_limit=time_limit)
