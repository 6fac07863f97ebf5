"""One processor for each worker, so that no method gains by threads what another loses."""

import os
import resource
import tempfile
from pathlib import Path
from typing import IO

_held: list[IO[str]] = []  # A lock lasts for as long as its file is open.


def claim_processor() -> int | None:
    """Bind this process to a processor that no other worker of this machine holds.

    Returns
    -------
    Its number, or ``None`` where all are held or the system cannot tell; then nothing is bound.
    """
    if not hasattr(os, "sched_setaffinity"):
        return None
    import fcntl

    folder = Path(tempfile.gettempdir()) / f"windopt-processors-{os.getuid()}"
    folder.mkdir(exist_ok=True)
    for number in sorted(os.sched_getaffinity(0)):
        file = (folder / str(number)).open("w", encoding="utf-8")
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            file.close()
            continue
        _held.append(file)
        os.sched_setaffinity(0, {number})
        return number
    return None


def processor_time() -> float:
    """Return the processor time of this process and of those it has started and ended [s]."""
    spent = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in spent)
