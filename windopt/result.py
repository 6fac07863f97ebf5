"""What a method found, and how sure it is."""

from dataclasses import dataclass, replace
from enum import StrEnum
from math import inf, isfinite
from typing import Generic, TypeVar

Solution = TypeVar("Solution")
Other = TypeVar("Other")


class Status(StrEnum):
    """Why a method ended; :attr:`sentence` says it in words."""

    OPTIMAL = "optimal"
    LOCALLY_OPTIMAL = "locally_optimal"
    FEASIBLE = "feasible"
    INFEASIBLE = "infeasible"
    NO_SOLUTION = "no_solution"
    INTERRUPTED = "interrupted"

    @property
    def sentence(self) -> str:
        """The status as a sentence a user can act on."""
        return _SENTENCES[self]


_SENTENCES = {
    Status.OPTIMAL: "Proved: no solution is better by more than the gap asked for.",
    Status.LOCALLY_OPTIMAL: "First-order conditions hold; a better solution may lie elsewhere.",
    Status.FEASIBLE: "A solution that keeps every constraint, without a proof that it is best.",
    Status.INFEASIBLE: "Proved: no solution keeps every constraint.",
    Status.NO_SOLUTION: "A limit was reached before any solution was found.",
    Status.INTERRUPTED: "Stopped by the user; the solution, if any, is the best found so far.",
}


@dataclass(frozen=True)
class Result(Generic[Solution]):
    """Outcome of one method on one problem.

    Parameters
    ----------
    status
        Why the method ended.
    solution
        The best solution found; ``None`` where there is none.
    objective, bound
        Its value, and the proven bound on the value of any solution.
    runtime
        Wall-clock time [s].
    bound_source
        What proves the bound; empty where nothing does.
    reason
        Why there is no solution, or what else the status does not say.
    asked_gap
        The gap at which the method was asked to stop [-]; OPTIMAL is a proof to within it.
    """

    status: Status
    solution: Solution | None
    objective: float
    bound: float
    runtime: float
    bound_source: str = ""
    reason: str = ""
    asked_gap: float = 0.0

    @property
    def gap(self) -> float:
        """Distance between objective and bound, as a fraction of the objective [-]."""
        if not (isfinite(self.objective) and isfinite(self.bound)):
            return inf
        distance = abs(self.objective - self.bound)
        return distance / abs(self.objective) if self.objective else (inf if distance else 0.0)

    def found(self) -> Solution:
        """Return the solution, or raise where there is none.

        Raises
        ------
        ValueError
            With the reason, if the method found no solution.
        """
        if self.solution is None:
            raise ValueError(f"{self.status.sentence} {self.reason}".strip())
        return self.solution

    def carrying(self, solution: Other | None) -> "Result[Other]":
        """Return the same outcome with ``solution`` in place of this one's."""
        return Result(
            self.status,
            solution,
            self.objective,
            self.bound,
            self.runtime,
            self.bound_source,
            self.reason,
            self.asked_gap,
        )

    def timed(self, runtime: float) -> "Result[Solution]":
        """Return the same outcome with ``runtime`` [s] in place of this one's."""
        return replace(self, runtime=runtime)
