"""The rounds in which :mod:`windopt.solving.integer` solves a program and adds rows to it."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import takewhile
from math import inf, nan
from time import perf_counter
from typing import Protocol

import highspy
import numpy as np
from highspy.highs import HighspyArray, highs_linear_expression
from numpy.typing import NDArray

from windopt.result import Effort, Result, Status
from windopt.solving.rows import rows
from windopt.solving.watched import News, run
from windopt.trace import Progress

HIGHS = highspy.HighsModelStatus
TOLERANCE = 1e-5  # Ten times HiGHS's own, which it applies to a scaled and presolved program.
WHOLE = 1e-9  # Of a whole number; a vertex is off by rounding only.
RELAXATION_SHARE = 0.5  # Part of the time limit after which a plan matters more than the bound.


class IntegerProgram(Protocol):
    """A HiGHS model to be minimised, its decisions, and the rows left out of it."""

    @property
    def model(self) -> highspy.Highs: ...

    @property
    def x(self) -> HighspyArray: ...

    def cuts(self, x: NDArray[np.float64]) -> Iterator[highs_linear_expression]:
        """Yield the rows that ``x`` violates."""


@dataclass
class Rounds:
    """The rounds on one program, and the best solution and bound they have given so far."""

    program: IntegerProgram
    time_limit: float
    progress: Progress | None
    began: float = field(default_factory=perf_counter)
    values: NDArray[np.float64] | None = None  # of all columns, at the best solution
    objective: float = inf
    bound: float = -inf
    stage: str = ""  # of the whole program; none while a start is completed
    proof: str = ""
    shown: tuple[float, float] = (inf, -inf)  # objective and bound last reported
    reason: str = ""
    optimal: bool = False
    infeasible: bool = False
    interrupted: bool = False
    cut_bound: float = nan  # of the relaxation with its rows
    rounds: int = 0
    added: int = 0
    nodes: int = 0

    def __post_init__(self) -> None:
        lp = self.program.model.getLp()
        self.cost, self.offset = np.array(lp.col_cost_), lp.offset_
        self.rows = rows(lp)  # Those added later are of ``cuts``, which is asked anyway.
        self.whole = np.array(
            [kind != highspy.HighsVarType.kContinuous for kind in lp.integrality_], dtype=bool
        )
        self.column = np.array([v.index for v in self.program.x.flat], dtype=np.int32)

    def begin(self, start: NDArray[np.float64] | None) -> None:
        """Keep ``start`` if the other columns can follow it.

        HiGHS could complete it too, but reports bounds of that smaller program while it does.
        """
        if start is None:
            return
        model, column, value = self.program.model, self.column, np.ravel(start).astype(float)
        lower, upper = self.rows.col_lower[column], self.rows.col_upper[column]
        if (value < lower).any() or (value > upper).any():
            return
        model.setOptionValue("solve_relaxation", True)
        try:
            model.changeColsBounds(column.size, column, value, value)
            if self._run(self.time_limit) == HIGHS.kOptimal:
                self._keep(self._values())
        finally:
            model.changeColsBounds(column.size, column, lower, upper)
            model.clearSolver()
        self.reason = ""

    def relax(self) -> None:
        """Solve the relaxation until it keeps every row or has had its share of the time.

        Where its solution is whole and breaks no row, it is that of the program.
        """
        model, limit = self.program.model, RELAXATION_SHARE * self.time_limit
        self.stage = "linear relaxation"
        model.setOptionValue("solve_relaxation", True)
        tied = np.flatnonzero(abs(self.rows.A) @ ~self.whole).astype(np.int32)
        lower, upper = self.rows.row_lower[tied], self.rows.row_upper[tied]
        free = np.full(tied.size, inf)
        try:
            model.changeRowsBounds(tied.size, tied, -free, free)
            self._relax(limit / 2)
        finally:
            model.changeRowsBounds(tied.size, tied, lower, upper)
        if tied.size > 0 and not self.optimal:
            self._relax(limit)
        self.cut_bound = self.bound

    def branch(self) -> None:
        """Solve the integer program until its optimum keeps every row."""
        model = self.program.model
        self.stage = "branch and cut"
        model.setOptionValue("solve_relaxation", False)
        while not (self.infeasible or self.optimal):
            if self.values is not None:
                model.setSolution(self.values.size, np.arange(self.values.size), self.values)
            status = self._run(self.time_limit)
            if status not in (HIGHS.kOptimal, HIGHS.kTimeLimit, HIGHS.kInterrupt):
                break
            self._raise_bound(model.getInfo().mip_dual_bound)
            self.nodes += max(0, model.getInfo().mip_node_count)
            if status != HIGHS.kOptimal:
                break
            values = self._rounded(self._values())
            if not self._add_violated(values, self.time_limit):
                self.optimal = self._keep(values)
                break

    @property
    def effort(self) -> Effort:
        """What it took so far."""
        return Effort(nan, self.cut_bound, self.rounds, self.added, self.nodes)

    def result(self) -> Result[NDArray[np.float64]]:
        """Return what is known, in windopt's words."""
        runtime = perf_counter() - self.began
        if self.infeasible and self.values is None:
            return Result(Status.INFEASIBLE, None, inf, inf, runtime, self.proof, self.reason)
        if self.optimal:
            status = Status.OPTIMAL
        elif self.interrupted:
            status = Status.INTERRUPTED
        else:
            status = Status.NO_SOLUTION if self.values is None else Status.FEASIBLE
        x = None if self.values is None else self._x(self.values)
        if self.infeasible:
            reason = "HiGHS called the program infeasible, which this solution disproves."
            return Result(status, x, self.objective, -inf, runtime, reason=reason)
        bound = min(self.bound, self.objective)
        return Result(status, x, self.objective, bound, runtime, self.proof, self.reason)

    def _relax(self, limit: float) -> None:
        while self._run(limit) == HIGHS.kOptimal:
            self._raise_bound(self.program.model.getInfo().objective_function_value)
            values = self._values()
            if not self._add_violated(values, limit):
                self.optimal = self._solves(values) and self._keep(values)
                break

    def _solves(self, values: NDArray[np.float64]) -> bool:
        """Whether a solution of the relaxation is one of the program: whole, and in all rows."""
        fraction = np.abs(values - np.rint(values))[self.whole].max(initial=0.0)
        return bool(fraction <= WHOLE and self.rows.largest_violation(values) <= TOLERANCE)

    def _run(self, limit: float) -> highspy.HighsModelStatus:
        """Run HiGHS until ``limit`` at most, and return how it ended."""
        model = self.program.model
        if self.interrupted or self._left(limit) <= 0.0:
            return HIGHS.kNotset
        status = self._ending(limit)
        if status == HIGHS.kUnboundedOrInfeasible:  # Presolve cannot tell which, a solve can.
            _, presolve = model.getOptionValue("presolve")
            model.setOptionValue("presolve", "off")
            try:
                status = self._ending(limit)
            finally:
                model.setOptionValue("presolve", presolve)
        if status == HIGHS.kInfeasible and self.stage:
            self.infeasible, self.proof = True, f"HiGHS, {self.stage}"
        if status not in (HIGHS.kOptimal, HIGHS.kTimeLimit, HIGHS.kInterrupt):
            self.reason = f"HiGHS ended with: {model.modelStatusToString(status)}."
        return status

    def _ending(self, limit: float) -> highspy.HighsModelStatus:
        """Run HiGHS once, and return what it says of it."""
        self.program.model.setOptionValue("time_limit", max(0.0, self._left(limit)))
        self.interrupted |= run(self.program.model, self._hear)
        status: highspy.HighsModelStatus = self.program.model.getModelStatus()
        return status

    def _hear(self, news: News) -> None:
        """Take in what HiGHS has found so far; its bound counts once the run has ended."""
        if news.values is not None:
            self._keep(news.values)
        self._report(news.bound)

    def _raise_bound(self, bound: float) -> None:
        if bound > self.bound:
            self.bound, self.proof = bound, f"HiGHS, {self.stage}"
            self._report(bound)

    def _keep(self, values: NDArray[np.float64]) -> bool:
        """Keep the solution if it is the best, and return whether it keeps every row."""
        values = self._rounded(values)
        if next(self.program.cuts(self._x(values)), None) is not None:
            return False
        if (violation := self.rows.largest_violation(values)) > TOLERANCE:
            self.reason = f"HiGHS returned a solution that breaks a row by {violation:.2g}."
            return False
        objective = float(self.cost @ values) + self.offset
        if objective < self.objective:
            self.objective, self.values, self.reason = objective, values, ""
            self._report(self.bound)
        return True

    def _report(self, bound: float) -> None:
        shown = self.objective, min(max(bound, self.shown[1]), self.objective)
        if self.progress is not None and shown != self.shown:
            self.shown = shown
            self.progress(*shown)

    def _add_violated(self, values: NDArray[np.float64], limit: float) -> int:
        """Add the rows that ``values`` break, as far as time allows, and return how many."""
        rows = list(
            takewhile(lambda _: self._left(limit) > 0.0, self.program.cuts(self._x(values)))
        )
        self.program.model.addConstrs(rows)
        self.rounds += bool(rows)
        self.added += len(rows)
        return len(rows)

    def _values(self) -> NDArray[np.float64]:
        return np.asarray(self.program.model.getSolution().col_value)

    def _rounded(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.where(self.whole, np.rint(values), values)

    def _x(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the values of ``x`` among those of all columns."""
        return values[self.column].reshape(self.program.x.shape)

    def _left(self, limit: float) -> float:
        """Return the time left until ``limit`` [s]."""
        return self.began + limit - perf_counter()
