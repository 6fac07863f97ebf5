"""A better plan, by planning neighbouring flights anew.

A few flights are a small problem of their own, whose best plan is soon proved; where it takes less
time than theirs, so does the whole plan. The method is POPMUSIC [1], with an exact method for
the small problems as in [2].

* [1] Taillard & Voss (2002), in *Essays and Surveys in Metaheuristics*, 613-629.
* [2] Queiroga, Sadykov & Uchoa (2021), *Computers & Operations Research* 136, 105475.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import NamedTuple

import numpy as np

from windopt.domain.routing import RoutingInstance
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.first_plan import find_plan
from windopt.solving.exact.search import CLOSED, Flight, Search

SIZES = (30, 42)
"""Most turbines of a part, at first and when all such are planned anew."""
SHARE = 0.33
"""Share of the time so far that planning anew may take."""
PATIENCE, LEAST_PATIENCE = 0.01, 1.0
"""Part of the time so far that one problem gets, and the least [s]."""
THOROUGH = 3
"""Times the first local search for a plan from scratch."""

Solve = Callable[[Search, Sequence[Flight]], object]
"""Offers a search better plans than some flights to begin with, until its time is up."""


class Part(NamedTuple):
    """Flights near one another, and turbines near them that no flight visits."""

    flights: frozenset[Flight]
    left_out: frozenset[int]

    @property
    def turbines(self) -> frozenset[int]:
        """All their turbines."""
        return self.left_out.union(*(path for _, path in self.flights))


@dataclass
class Replanning:
    """Plans whose parts are planned anew: the best, then others from scratch.

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
    trial
        A search of its own, whose plan is planned anew.
    parts
        Those of its plan that are not planned anew yet.
    known
        Time of the best plan when flights were last planned anew.
    from_scratch, rival
        Plans made from scratch so far, and the time of the best plan when the last was begun.
    spent
        Time that all took so far [s].
    """

    search: Search
    solve: Solve
    seed: int
    trial: Search = field(init=False)
    parts: Iterator[Part] = field(init=False)
    known: float = inf
    from_scratch: int = 0
    rival: float = inf
    spent: float = 0.0

    def __post_init__(self) -> None:
        distance = self.search.round_trips.copy()
        np.fill_diagonal(distance, -1.0)
        self._near = np.argsort(distance, axis=1, kind="stable")
        self._random = np.random.default_rng(self.seed)

    def improve(self, ahead: float = 0.0) -> None:
        """Plan parts anew while there is time for it, and until the best plan is found again.

        Parameters
        ----------
        ahead
            Time for which there will be no other occasion [s]; it has its share as well.

        Raises
        ------
        KeyboardInterrupt
            If the user interrupts.
        OutOfTime
            If time is up.
        """
        search, clock = self.search, self.search.clock
        if search.n <= SIZES[-1]:
            return  # the whole is no more than a part
        while search.found and not search.closed and self.spent < SHARE * (clock.elapsed + ahead):
            began = clock.elapsed
            if search.objective < self.known - CLOSED:
                self._take(search.flights)
                self.rival = inf
            part = next(self.parts, None)
            if part is not None:
                self._replan(part, min(clock.left, max(LEAST_PATIENCE, PATIENCE * began)))
            elif abs(self.trial.objective - self.rival) > CLOSED:
                self._begin_anew()
            else:
                return
            self.known = search.objective
            self.spent += clock.elapsed - began
            clock.check()

    def _take(self, flights: Sequence[Flight]) -> None:
        """Plan parts of another plan anew."""
        self.trial = Search(self.search.instance, self.search.clock)
        self.trial.offer(flights)
        self.parts = self._unseen()

    def _begin_anew(self) -> None:
        """Make a plan from scratch."""
        self._take(())
        self.from_scratch += 1
        self.rival = self.search.objective
        try:
            find_plan(self.trial, self.seed + self.from_scratch, effort=THOROUGH)
        finally:
            self.search.offer(self.trial.flights)

    def _unseen(self) -> Iterator[Part]:
        """Yield parts of the plan as it then is, small ones first, no same turbines twice."""
        seen: set[frozenset[int]] = {frozenset()}
        for most in SIZES:
            while True:
                parts = (self._around(i, most) for i in self._random.permutation(self.search.n))
                part = next((part for part in parts if part.turbines not in seen), None)
                if part is None:
                    break
                seen.add(part.turbines)
                yield part

    def _around(self, turbine: int, most: int) -> Part:
        """Return the part around a turbine, of so many turbines at most; it may have none."""
        flight = {i: each for each in self.trial.flights for i in each[1]}
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
        return Part(frozenset(flights), frozenset(left_out))

    def _replan(self, part: Part, limit: float) -> None:
        """Offer the plan with the best flights found for a part of it."""
        turbines = sorted(part.turbines)
        place = {i: at for at, i in enumerate(turbines)}
        others = [each for each in self.trial.flights if each not in part.flights]
        start = [(d, tuple(place[i] for i in path)) for d, path in part.flights]
        with Clock(limit) as clock:
            few = Search(self._problem(turbines, others), clock)
            try:
                self.solve(few, start)
            finally:  # an interrupt passes, and what was found before it stays
                found = [(d, tuple(turbines[i] for i in path)) for d, path in few.flights]
                self.trial.offer([*others, *found])
                self.search.offer(self.trial.flights)
        self.search.note("%d turbines in %d flights planned anew", len(turbines), len(start))

    def _problem(self, turbines: Sequence[int], others: list[Flight]) -> RoutingInstance:
        """Return the problem of some turbines where other flights are flown as well."""
        instance = self.search.instance.subset(turbines)
        if instance.max_flights is None:
            return instance
        sent = np.bincount([d for d, _ in others], minlength=len(instance.t))
        return replace(instance, max_flights=instance.max_flights - sent)
