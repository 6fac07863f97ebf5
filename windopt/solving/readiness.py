"""Readiness: the loops of the exact method compiled before the time of a search begins.

numba compiles a loop when it is first called and keeps it on disk. A search calls some of them
early and some late, or never: small farms that call all compile them at once, and a stamp beside
what numba keeps says that this was done, by what and from which sources.
"""

from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from platform import machine
from sys import implementation

import llvmlite.binding as llvm
import numba
import numpy as np

from windopt.domain.routing import RoutingInstance
from windopt.result import Status
from windopt.solving.column_generation import column_generation
from windopt.solving.exact.clock import Clock, OutOfTime
from windopt.solving.exact.labelling import labels
from windopt.solving.exact.pricing import MOST_LABELS, LabelsOverflow
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone

STAMP = "windopt-exact.stamp"
LIMIT, MEMORY = 600.0, 1e9
"""Time [s] after which loops that are left are compiled when they are needed, and what small farms
may take [bytes]."""


@cache
def make_ready() -> None:
    """Have all loops compiled, unless they are.

    Raises
    ------
    KeyboardInterrupt
        If the user does not want to wait.
    """
    if not is_compiled():
        compile_loops()
        with suppress(OSError):  # then it is done again by the next process
            _stamp().write_text(_fingerprint(), encoding="utf-8")


def is_compiled() -> bool:
    """Tell whether all loops were compiled from these sources, for this processor."""
    try:
        return _stamp().read_text(encoding="utf-8") == _fingerprint()
    except OSError:
        return False


def _stamp() -> Path:
    """Return the file beside what numba keeps, one for each Python."""
    kept = Path(labels.stats.cache_path)  # type: ignore[attr-defined]
    return kept / f"{implementation.cache_tag}-{STAMP}"


def _fingerprint() -> str:
    """Return a hash of all that compiled loops depend on."""
    made_by = numba.__version__, llvm.llvm_version_info, machine(), llvm.get_host_cpu_name()
    digest = sha256(repr(made_by).encode())
    for source in sorted((Path(__file__).parent / "exact").glob("*.py")):
        digest.update(source.read_bytes())
    return digest.hexdigest()


def compile_loops() -> None:
    """Call every loop: in a search, and for rows of all kinds, which small farms do not need.

    Raises
    ------
    KeyboardInterrupt
        If the user does not want to wait.
    """
    farm = _small_farm()
    with suppress(OutOfTime, LabelsOverflow), Clock(LIMIT) as clock:
        search = Search(farm, clock)
        search.offer(alone(search.networks))
        relaxation = Relaxation(search, MEMORY, search.counts)
        relaxation.begin()
        relaxation.enter_crowded_sets()
        relaxation.cut(MOST_LABELS)
        relaxation.fix_arcs()
    if column_generation(farm, time_limit=LIMIT, memory=MEMORY).status is Status.INTERRUPTED:
        raise KeyboardInterrupt


def _small_farm() -> RoutingInstance:
    """Return a farm that has too many flights to list at first, and rows over the list to add.

    Turbines stand not quite on a grid, a station beside it; legs into the wind take longer. Other
    numbers did as well, but few: most farms of this size are proved without such rows.
    """
    rng = np.random.default_rng(2)
    grid = 800.0 * np.argwhere(np.ones((4, 6)))
    turbines = grid + rng.uniform(0.0, 300.0, grid.shape)
    station = np.array([[-500.0, 1200.0]])
    nodes = np.vstack([station, turbines])
    way = nodes[None] - nodes[:, None]
    t = np.hypot(way[..., 0], way[..., 1]) / 16.0 + way[..., 0] / 60.0
    allowed = np.ones((1, len(turbines)), bool)
    return RoutingInstance(t[None], np.array([650.0]), station, turbines, np.zeros(2), allowed)
