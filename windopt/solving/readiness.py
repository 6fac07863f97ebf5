"""Readiness: the loops of the exact method compiled before the time of a search begins.

numba compiles a loop when it is first called and keeps it on disk. A search calls some of them
early and some late, or never: a small farm that calls all compiles them at once.
"""

from pathlib import Path

import numpy as np

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.grown_sets import grown_sets
from windopt.solving.exact.half_flights import half_flights
from windopt.solving.exact.joined_halves import join_halves
from windopt.solving.exact.joins import join
from windopt.solving.exact.labelling import labels
from windopt.solving.exact.pricing import MOST_LABELS
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone
from windopt.solving.exact.subset_row_cuts import violations

LOOPS = labels, join, half_flights, join_halves, violations, grown_sets
"""Loops that each call others, in the order in which they are compiled."""
LIMIT, MEMORY = 600.0, 1e9
"""Time in which all are compiled on any machine [s], and what a small farm may take [bytes]."""


def is_compiled() -> bool:
    """Tell whether the compiled loops are on disk, and no older than their sources."""
    return all(_on_disk(loop) for loop in LOOPS)


def _on_disk(loop: object) -> bool:
    code = loop.py_func.__code__  # type: ignore[attr-defined]
    source = Path(code.co_filename)
    folder = Path(loop.stats.cache_path)  # type: ignore[attr-defined]
    kept = folder.glob(f"{source.stem}.{code.co_name}-{code.co_firstlineno}.*.nbi")
    return any(each.stat().st_mtime >= source.stat().st_mtime for each in kept)


def compile_loops() -> None:
    """Call every loop, so that those not yet on disk are compiled.

    Raises
    ------
    KeyboardInterrupt
        If the user does not want to wait.
    """
    farm = _jittered_grid()
    if column_generation(farm, time_limit=LIMIT).status is Status.INTERRUPTED:
        raise KeyboardInterrupt
    with Clock(LIMIT) as clock:
        search = Search(farm, clock)
        search.offer(alone(search.networks))
        relaxation = Relaxation(search, MEMORY, search.counts)
        relaxation.begin()
        relaxation.enter_crowded_sets()
        relaxation.cut(MOST_LABELS)
        relaxation.fix_arcs()


def _jittered_grid() -> RoutingInstance:
    """Return a farm of one station that takes a list of flights, and rows over it, to prove."""
    rng = np.random.default_rng(2)
    grid = 800.0 * np.argwhere(np.ones((4, 6)))
    turbines = grid + rng.uniform(0.0, 300.0, grid.shape)
    station = np.array([[-500.0, 1200.0]])
    nodes = np.vstack([station, turbines])
    way = nodes[None] - nodes[:, None]
    t = np.hypot(way[..., 0], way[..., 1]) / 16.0 + way[..., 0] / 60.0
    allowed = np.ones((1, len(turbines)), bool)
    return RoutingInstance(t[None], np.array([650.0]), station, turbines, np.zeros(2), allowed)
