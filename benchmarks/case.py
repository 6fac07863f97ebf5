"""What is run: a problem's instance, a method, a limit and a seed, all by name.

A case is words and numbers only, so that it can be sent to another process or machine, and what
it stands for is made there.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

Record = dict[str, Any]
Key = tuple[str, str, str, float, int]


@dataclass(frozen=True)
class Case:
    """One answer to be measured.

    Parameters
    ----------
    problem, instance, method
        By name.
    time_limit
        Wall-clock limit [s].
    seed
        Of whatever the method draws at random.
    """

    problem: str
    instance: str
    method: str
    time_limit: float
    seed: int = 0

    @property
    def key(self) -> Key:
        """What tells this case from all others."""
        return self.problem, self.instance, self.method, self.time_limit, self.seed

    @property
    def record(self) -> Record:
        """The case as the beginning of its line."""
        return asdict(self)

    def __str__(self) -> str:
        return f"{self.problem} {self.instance} by {self.method}"


@dataclass(frozen=True)
class Problem:
    """A kind of benchmark: which instances and methods there are, and how one case is measured.

    Parameters
    ----------
    instances
        Names of the instances of a set: ``"small"``, ``"medium"`` or ``"full"``.
    methods
        Names of the methods that a set runs unless others are named.
    time_limits
        Limit of each set unless another is given [s].
    measure
        Returns what a case's line says beside the case itself.
    warm_up
        Runs a method once on something tiny, so that no case pays for what is compiled.
    show
        Returns what a run prints of its lines, beside how many there are.
    """

    instances: Callable[[str], Sequence[str]]
    methods: Callable[[str], Sequence[str]]
    time_limits: Mapping[str, float]
    measure: Callable[[Case], Record]
    warm_up: Callable[[str], None] = lambda method: None
    show: Callable[[Sequence[Record]], str] = lambda records: ""
