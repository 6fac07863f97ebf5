"""Processors for each worker alone, so that no method gains by threads what another loses."""

import os
import resource
import tempfile
from pathlib import Path
from typing import IO

EACH = "WINDOPT_BENCHMARK_PROCESSORS"
"""Names the variable that tells a worker how many processors to claim."""

_held: list[IO[str]] = []  # A lock lasts for as long as its file is open.


def claim_processors(most: int = 1) -> set[int]:
    """Bind this process to processors that no other worker of this machine holds.

    Parameters
    ----------
    most
        How many to claim at most.

    Returns
    -------
    Their numbers, none where all are held or the system cannot tell; then nothing is bound.
    """
    if not hasattr(os, "sched_setaffinity"):
        return set()
    import fcntl

    folder = Path(tempfile.gettempdir()) / f"windopt-processors-{os.getuid()}"
    folder.mkdir(exist_ok=True)
    claimed: set[int] = set()
    for number in sorted(os.sched_getaffinity(0)):
        if len(claimed) == most:
            break
        file = (folder / str(number)).open("w", encoding="utf-8")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.close()
            continue
        _held.append(file)
        claimed.add(number)
    if claimed:
        os.sched_setaffinity(0, claimed)
    return claimed


def processor_time() -> float:
    """Return the processor time of this process and of those it has started and ended [s]."""
    spent = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in spent)
