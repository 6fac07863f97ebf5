"""A better plan, by planning neighbouring flights anew.

A few flights are a small problem of their own, whose best plan is soon proved; where it takes less
time than theirs, so does the whole plan. The method is POPMUSIC [1], with an exact method for
the small problems as in [2].

* [1] Taillard & Voss (2002), in *Essays and Surveys in Metaheuristics*, 613-629.
* [2] Queiroga, Sadykov & Uchoa (2021), *Computers & Operations Research* 136, 105475.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from windopt.domain.routing import Route, RoutingInstance
from windopt.result import Result, Status
from windopt.solving.exact.first_plan import find_plan
from windopt.solving.exact.search import CLOSED, Flight, Search

SIZES = (30, 42)
"""Most turbines of one problem, at first and when all such are solved."""
SHARE = 0.33
"""Share of the time so far that planning anew may take."""
PATIENCE, LEAST_PATIENCE = 0.01, 1.0
"""Part of the time so far that one problem gets, and the least [s]."""
THOROUGH = 3
"""Times the first local search for a plan from scratch."""

Ints = NDArray[np.intp]
Solve = Callable[[RoutingInstance, tuple[Route, ...], float], Result[tuple[Route, ...]]]
"""Improves a plan of an instance within a time limit [s]."""


class Neighbours(NamedTuple):
    """Flights near one another, and turbines near them that no flight visits."""

    flights: frozenset[Flight]
    left_out: frozenset[int]

    @property
    def turbines(self) -> frozenset[int]:
        """All their turbines."""
        return self.left_out.union(*(path for _, path in self.flights))


@dataclass
class Replanning:
    """Plans whose flights are planned anew, a few at a time: the best, then others from scratch.

    Parameters
    ----------
    search
        To offer better plans to.
    solve
        An exact method.
    seed
        Of the order in which flights are planned anew, and of plans from scratch.

    Attributes
    ----------
    plan
        What is planned anew, in a search of its own.
    size
        Place in :data:`SIZES`.
    known
        The best plan when flights were last planned anew.
    from_scratch, rival
        Plans made from scratch so far, and what the last was to be better than.
    spent
        Time that all took so far [s].
    """

    search: Search
    solve: Solve
    seed: int
    plan: Search = field(init=False)
    size: int = 0
    known: float = inf
    from_scratch: int = 0
    rival: float = inf
    spent: float = 0.0

    def __post_init__(self) -> None:
        there = self.search.instance.t[:, 1:, 1:].min(axis=0)
        distance = there + there.T
        np.fill_diagonal(distance, -1.0)
        self._near = np.argsort(distance, axis=1, kind="stable")
        self._random = np.random.default_rng(self.seed)
        self._seen: set[frozenset[int]] = set()

    def improve(self) -> None:
        """Plan flights anew while there is time for it, and no plan was found a second time.

        Raises
        ------
        KeyboardInterrupt
            If the user interrupts.
        OutOfTime
            If time is up.
        """
        search, clock = self.search, self.search.clock
        while search.found and not search.closed and self.spent < SHARE * clock.elapsed:
            began = clock.elapsed
            if search.objective < self.known - CLOSED:
                self._take(search.flights)
                self.rival = inf
            neighbours = self._unseen()
            if neighbours is not None:
                self._replan(neighbours, min(clock.left, max(LEAST_PATIENCE, PATIENCE * began)))
            elif abs(self.plan.objective - self.rival) <= CLOSED:
                return
            else:
                self._begin_anew()
            self.known = search.objective
            self.spent += clock.elapsed - began
            clock.check()

    def _take(self, flights: Sequence[Flight]) -> None:
        """Plan the flights of another plan anew."""
        self.plan = Search(self.search.instance, self.search.clock)
        self.plan.offer(flights)
        self.size = 0
        self._seen.clear()

    def _begin_anew(self) -> None:
        """Make a plan from scratch, to be better than the best."""
        self._take(())
        self.from_scratch += 1
        self.rival = self.search.objective
        find_plan(self.plan, self.seed + self.from_scratch, effort=THOROUGH)

    def _unseen(self) -> Neighbours | None:
        """Return neighbours not planned anew yet, few unless there are no few."""
        while self.size < len(SIZES) and SIZES[self.size] < self.search.n:
            for i in self._random.permutation(self.search.n):
                neighbours = self._around(i, SIZES[self.size])
                turbines = neighbours.turbines
                if turbines and turbines not in self._seen:
                    self._seen.add(turbines)
                    return neighbours
            self.size += 1
        return None

    def _around(self, turbine: int, most: int) -> Neighbours:
        """Return those nearest to a turbine, of so many turbines at most: none if even one
        flight visits more."""
        flight = {i: each for each in self.plan.flights for i in each[1]}
        flights: set[Flight] = set()
        left_out: set[int] = set()
        turbines = 0
        for i in self._near[turbine].tolist():
            each = flight.get(i)
            if each in flights:
                continue
            turbines += 1 if each is None else len(each[1])
            if turbines > most:
                break
            if each is None:
                left_out.add(i)
            else:
                flights.add(each)
        return Neighbours(frozenset(flights), frozenset(left_out))

    def _replan(self, neighbours: Neighbours, limit: float) -> None:
        """Offer the plan with the best flights found in place of neighbours."""
        turbines = np.array(sorted(neighbours.turbines))
        place = {i: at for at, i in enumerate(turbines.tolist())}
        others = [each for each in self.plan.flights if each not in neighbours.flights]
        start = tuple(Route(d, tuple(place[i] for i in path)) for d, path in neighbours.flights)
        result = self.solve(self._problem(turbines, others), start, limit)
        found = [(d, tuple(turbines[list(path)].tolist())) for d, path in result.solution or ()]
        self.plan.offer([*others, *found])
        self.search.offer(self.plan.flights)
        if result.status is Status.INTERRUPTED:
            raise KeyboardInterrupt

    def _problem(self, turbines: Ints, others: list[Flight]) -> RoutingInstance:
        """Return the problem of some turbines where other flights are flown as well."""
        instance = self.search.instance.subset(turbines)
        if instance.max_flights is None:
            return instance
        sent = np.bincount([d for d, _ in others], minlength=len(instance.t))
        return replace(instance, max_flights=instance.max_flights - sent)
