"""What a method found, and how sure it is."""

from dataclasses import dataclass, replace
from enum import StrEnum
from math import inf, isfinite, nan
from typing import Generic, NamedTuple, TypeVar

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
    Status.OPTIMAL: "Proved best.",
    Status.LOCALLY_OPTIMAL: "First-order conditions hold; a better solution may lie elsewhere.",
    Status.FEASIBLE: "A solution that keeps every constraint, without a proof that it is best.",
    Status.INFEASIBLE: "Proved: no solution keeps every constraint.",
    Status.NO_SOLUTION: "A limit was reached before any solution was found.",
    Status.INTERRUPTED: "Stopped by the user; the solution, if any, is the best found so far.",
}


class Moment(NamedTuple):
    """What was known at a time [s] since the start: the best objective and the best bound."""

    time: float
    objective: float
    bound: float


@dataclass(frozen=True)
class Effort:
    """What a proof by relaxations took, as far as the method tells.

    Parameters
    ----------
    lp_bound
        Value of the linear relaxation as it was stated.
    cut_bound
        Its value once rows that tighten it were added, before any branching.
    rounds, rows
        How often rows were added, and how many.
    nodes
        Nodes of the search tree.
    """

    lp_bound: float = nan
    cut_bound: float = nan
    rounds: int = 0
    rows: int = 0
    nodes: int = 0


@dataclass(frozen=True, repr=False)
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
    trace
        Objective and bound whenever one of them improved, in order of time.
    effort
        What the proof took.
    """

    status: Status
    solution: Solution | None
    objective: float
    bound: float
    runtime: float
    bound_source: str = ""
    reason: str = ""
    asked_gap: float = 0.0
    trace: tuple[Moment, ...] = ()
    effort: Effort = Effort()

    @property
    def gap(self) -> float:
        """Distance between objective and bound, as a fraction of the objective [-]."""
        if not (isfinite(self.objective) and isfinite(self.bound)):
            return inf
        distance = abs(self.objective - self.bound)
        return distance / abs(self.objective) if self.objective else (inf if distance else 0.0)

    @property
    def sentence(self) -> str:
        """The status as a sentence, with the gap where one was asked for."""
        if self.status is Status.OPTIMAL and self.asked_gap:
            return f"Proved best to within the gap of {100 * self.asked_gap:.3g}% asked for."
        return self.status.sentence

    def __repr__(self) -> str:
        """Return what is found and how sure it is; the solution itself would fill pages."""
        kind = "no solution" if self.solution is None else type(self.solution).__name__
        values = f"objective={self.objective:.6g}, bound={self.bound:.6g}, gap={self.gap:.4g}"
        return f"<Result: {self.status}, {kind}, {values}, runtime={self.runtime:.3g}>"

    def found(self) -> Solution:
        """Return the solution, or raise where there is none.

        Raises
        ------
        ValueError
            With the reason, if the method found no solution.
        """
        if self.solution is None:
            raise ValueError(f"{self.sentence} {self.reason}".strip())
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
            self.trace,
            self.effort,
        )

    def timed(self, runtime: float) -> "Result[Solution]":
        """Return the same outcome with ``runtime`` [s] in place of this one's."""
        return replace(self, runtime=runtime)
