"""Turning one rotor at a time by the exact wakes: the start and the finish of every search."""

from math import inf
from time import perf_counter

import numpy as np

from windopt.solving.wake_sweep import Floats, Sweep

PASSES = (5, 4)
"""How many misalignments each rotor tries in each pass; FLORIS's defaults."""


def refine(
    sweep: Sweep,
    *,
    around: float = inf,
    passes: tuple[int, ...] = PASSES,
    deadline: float = inf,
) -> Floats:
    """Turn every rotor, from upstream to downstream, to the best of a few misalignments.

    The first pass spreads them over the bounds, the next ones over half a step to either side of
    what was found; the middle, which is known, is left out there.

    Parameters
    ----------
    sweep
        The farm at the misalignments to start from; it is turned.
    around
        How far from there the first pass looks [rad].
    passes
        How many misalignments each pass tries.
    deadline
        When to stop, on the clock of ``time.perf_counter`` [s].

    Returns
    -------
    Misalignments [rad], shape ``(n,)``.
    """
    problem, best = sweep.problem, sweep.power
    lower = np.maximum(problem.lower, sweep.yaw - around)
    upper = np.minimum(problem.upper, sweep.yaw + around)
    for depth, count in enumerate(passes):
        for i in sweep.downstream_order():
            if perf_counter() >= deadline:
                return sweep.yaw
            yaws = np.linspace(lower[i], upper[i], count + (depth > 0))
            if depth:
                yaws = np.delete(yaws, count // 2)
            powers = sweep.tried(i, yaws)
            b = int(powers.argmax())
            if powers[b] > best:
                best = powers[b]
                sweep.turn(i, yaws[b])
                half = 0.5 * (yaws[1] - yaws[0])
                lower[i] = max(problem.lower[i], yaws[b] - half)
                upper[i] = min(problem.upper[i], yaws[b] + half)
    return sweep.yaw
