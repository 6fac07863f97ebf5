"""What a routing method is told beside the instance."""

from dataclasses import dataclass

from windopt.domain.routing import Route
from windopt.domain.turbine import require_not_negative
from windopt.solving.limits import require_gap, require_memory
from windopt.trace import Progress

MEMORY = 4e9
"""What a search may take unless told [bytes]."""


@dataclass(frozen=True)
class SearchOptions:
    """How long, how far and from where a routing method searches.

    Parameters
    ----------
    gap
        Relative gap at which to stop [-], below 1; it means nothing to a heuristic.
    time_limit
        Wall-clock limit [s].
    seed
        Of whatever is drawn at random.
    memory
        What the lists of an exact search may take [bytes].
    start
        Routes that keep every limit, to improve on.
    progress
        Called with objective and bound [s] whenever one of them improves.
    """

    gap: float = 0.0
    time_limit: float = 60.0
    seed: int = 0
    memory: float = MEMORY
    start: tuple[Route, ...] | None = None
    progress: Progress | None = None

    def __post_init__(self) -> None:
        require_not_negative("time_limit", self.time_limit)
        require_gap("gap", self.gap)
        require_memory("memory", self.memory)
