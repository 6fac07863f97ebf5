"""Serial refine: turn one rotor after the other, from upstream to downstream, coarse then fine.

The rival of the nonlinear program, as FLORIS's ``YawOptimizationSR`` has it: from zero yaw each
rotor in turn tries 5 misalignments over its bounds and keeps the best; a second pass tries 4 around
the one found. Two passes miss what needs rotors to turn together, and need neither derivatives nor
a smooth model.

* Fleming, Stanley, Bay, King, Simley, Doekemeijer & Mudafort (2022), Serial-refine method for fast
  wake-steering yaw optimization, *J. Physics: Conference Series* 2265, 032109.
"""

from math import inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from windopt.domain.yaw_problem import YawProblem
from windopt.result import Result, Status
from windopt.solving.rotor_by_rotor import refine
from windopt.solving.wake_sweep import Sweep
from windopt.solving.yaw_bound import UNWAKED
from windopt.wakes.farm import farm_power


def serial_refine(
    problem: YawProblem, *, time_limit: float = inf, seed: int = 0
) -> Result[NDArray[np.float64]]:
    """Turn rotors one after the other to where the farm delivers the most.

    Parameters
    ----------
    problem
        The farm and its winds.
    time_limit
        Wall-clock limit [s]; rotors not reached by then, or by Ctrl-C, stay as they are.
    seed
        Ignored: nothing is drawn at random.

    Returns
    -------
    Misalignments [rad], shape ``(n,)``.
    """
    begin = perf_counter()
    yaw, status = problem.facing, Status.FEASIBLE
    try:
        sweep = Sweep(problem, yaw)
        yaw = sweep.yaw  # turned in place
        refine(sweep, deadline=begin + time_limit)
    except KeyboardInterrupt:
        status = Status.INTERRUPTED
    power = float(farm_power(problem, yaw))
    runtime = perf_counter() - begin
    return Result(status, yaw, power, problem.bound, runtime, UNWAKED)
