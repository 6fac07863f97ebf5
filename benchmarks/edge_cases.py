"""The network on a small machine as cases: each way to run it, one window at a time."""

from benchmarks.case import Case, Problem, Record
from benchmarks.edge import measured

INSTANCE = "one-window"
METHOD = "every-network"
LIMITS = {"small": 300.0, "medium": 300.0, "full": 300.0}


def measure(case: Case) -> Record:
    """Time every network that is installed, in one process on one thread."""
    rows = [
        {"network": name, "microseconds": time or None, "bytes": size or None}
        for name, time, size in measured()
    ]
    return {"status": "timed", "networks": rows}


PROBLEM = Problem(
    instances=lambda chosen: (INSTANCE,) if chosen in LIMITS else (),
    methods=lambda chosen: [METHOD],
    time_limits=LIMITS,
    measure=measure,
)
