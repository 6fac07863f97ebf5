"""Integer programs through HiGHS, with rows added as solutions violate them.

HiGHS calls no one back for lazy constraints (its enumeration names such a callback, and nothing
fires it), so rows are added between solves, in two stages:

1. the linear relaxation, where a solve is cheap, until it keeps every row; first without the rows
   that tie continuous columns to the decisions, which on a large farm are most of them and take
   minutes, while the rest takes seconds and already gives most of the bound;
2. the integer program, until its optimum keeps every row.

A program with fewer rows has no worse an optimum, so the bound of every solve is valid, and the
best is kept. A solution is kept only if it breaks no row, left out or not; those that HiGHS
meets on its way are checked too, so that a limit or Ctrl-C still leaves a plan. It outweighs
HiGHS: a program that has one is never called infeasible.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from windopt.domain.turbine import require_not_negative
from windopt.errors import InvalidInput
from windopt.result import Result
from windopt.solving.limits import require_gap
from windopt.solving.rounds import IntegerProgram, Rounds
from windopt.trace import Progress, Recorder

__all__ = ["IntegerProgram", "solve"]


def solve(
    program: IntegerProgram,
    *,
    gap: float = 0.0,
    time_limit: float = 60.0,
    seed: int = 0,
    threads: int = 1,
    start: NDArray[np.float64] | None = None,
    progress: Progress | None = None,
) -> Result[NDArray[np.float64]]:
    """Minimise ``program``; the solution is the array of its ``x``.

    Rows that were found to be violated stay in ``program.model``.

    Parameters
    ----------
    gap
        Relative gap at which to stop [-], below 1.
    time_limit
        Wall-clock limit over all rounds [s].
    seed, threads
        Passed to HiGHS; with one thread the same inputs give the same answer.
    start
        Values of ``x`` to begin with, feasible or not; ``program.start`` where it has one.
    progress
        Called with the best objective and bound so far whenever one of them improves.

    Raises
    ------
    InvalidInput
        If ``gap`` is not in [0, 1), ``time_limit`` is negative, or ``start`` is not of the shape
        of ``x``.
    """
    require_gap("gap", gap)
    require_not_negative("time_limit", time_limit)
    if start is None:
        start = getattr(program, "start", None)
    if start is not None and start.shape != program.x.shape:
        raise InvalidInput("start", f"of shape {program.x.shape}", start.shape)

    model = program.model
    model.silent()
    model.setOptionValue("mip_rel_gap", gap)
    model.setOptionValue("mip_abs_gap", 0.0)
    model.setOptionValue("random_seed", seed)
    model.setOptionValue("threads", threads)

    recorder = Recorder(progress)
    search = Rounds(program, time_limit, recorder)
    try:
        search.begin(start)
        search.relax()
        search.branch()
    except KeyboardInterrupt:
        search.interrupted = True
    result = search.result()
    trace = recorder.until(result.objective, result.bound)
    return replace(result, asked_gap=gap, trace=trace, effort=search.effort)
