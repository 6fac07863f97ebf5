"""Certificates: why no plan takes less than a bound, in numbers that anyone can add up.

The duals of a linear program over flights are prices. A flight's *reduced cost* is its time less
the prices of the turbines it visits, and what else it pays. If none is negative, the prices add up
to a bound on every plan, and a plan cheaper than some target flies only flights whose reduced cost
is below the target less that bound. Those are soon few enough to be listed, priced again and again
with further terms, and parted into cases, until in every case the bound has reached the target.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput


@dataclass(frozen=True, eq=False)
class Round:
    """Prices, and the bound they prove over the flights that are left.

    Parameters
    ----------
    prices
        Of a visit to each turbine [s], shape ``(n,)``.
    tolls
        Prices of a flight from each station, and of any flight [s], shape ``(k + 1,)``.
    triples
        Turbines of which a plan has at most one flight visit two or more, shape ``(m, 3)``.
    penalties
        What such a flight pays for each triple [s], shape ``(m,)``, not negative.
    """

    prices: NDArray[np.float64]
    tolls: NDArray[np.float64]
    triples: NDArray[np.int64]
    penalties: NDArray[np.float64]

    def __post_init__(self) -> None:
        n, m = len(self.prices), len(self.penalties)
        for field, values in (
            ("prices", self.prices),
            ("tolls", self.tolls),
            ("penalties", self.penalties),
        ):
            _require_finite(field, values)
        if self.triples.shape != (m, 3):
            raise InvalidInput("triples", f"of shape {(m, 3)}", self.triples.shape)
        if not (np.diff(self.triples, axis=1, prepend=-1, append=n) > 0).all():
            raise InvalidInput("triples", f"to increase, from 0 to {n - 1}", self.triples)
        if not (self.penalties >= 0).all():
            raise InvalidInput("penalties", ">= 0", self.penalties.min())


@dataclass(frozen=True)
class Together:
    """Whether one flight visits both of two turbines, or each is visited by its own."""

    first: int
    second: int


@dataclass(frozen=True)
class Sent:
    """Whether at most so many flights are sent, or more.

    Parameters
    ----------
    station
        By which station; k for all of them.
    most
        Number of flights.
    """

    station: int
    most: int


Question = Together | Sent


@dataclass(frozen=True)
class Case:
    """A case of the proof: rounds of prices, and where they do not suffice two cases of it.

    Parameters
    ----------
    rounds
        In order; each but the last drops flights.
    question
        What tells the two cases apart.
    yes, no
        The cases, if there is a question.
    """

    rounds: tuple[Round, ...] = ()
    question: Question | None = None
    yes: "Case | None" = None
    no: "Case | None" = None

    def __post_init__(self) -> None:
        if any((self.question is None) != (case is None) for case in (self.yes, self.no)):
            raise InvalidInput("a case", "to have a question and its two cases, or neither", "one")

    def all(self) -> Iterator["Case"]:
        """Iterate over this case and those within it."""
        yield self
        for part in self.yes, self.no:
            if part is not None:
                yield from part.all()


@dataclass(frozen=True, eq=False)
class Proof:
    """Why no plan takes less than ``bound``, in numbers of turbines and stations from 0.

    Parameters
    ----------
    bound
        What is proved [s].
    prices, tolls
        Of a visit to each turbine, shape ``(n,)``, and of a flight as in a round [s]: no flight at
        all has a negative reduced cost.
    neighbours
        A hint that makes it quick to verify this: turbines near each turbine.
    case
        What follows for the flights that ``prices`` leave.
    """

    bound: float
    prices: NDArray[np.float64]
    tolls: NDArray[np.float64]
    neighbours: tuple[tuple[int, ...], ...]
    case: Case = Case()

    def __post_init__(self) -> None:
        n = len(self.prices)
        if not 0 <= self.bound < np.inf:
            raise InvalidInput("bound", "to be a finite number >= 0", self.bound)
        _require_finite("prices", self.prices)
        _require_finite("tolls", self.tolls)
        if len(self.neighbours) != n:
            raise InvalidInput("neighbours", f"of {n} turbines", f"{len(self.neighbours)}")
        for i in (i for near in self.neighbours for i in near):
            if not 0 <= i < n:
                raise InvalidInput("neighbours", f"to be between 0 and {n - 1}", i)


@dataclass(frozen=True, eq=False)
class Certificate:
    """A proof of a bound on the plans for one farm, fleet and wind.

    Parameters
    ----------
    turbines, stations
        Their names, in the order in which ``proof`` counts them.
    reason
        Why it proves less than was asked for, where it does; a file does not say it.
    """

    turbines: tuple[str, ...]
    stations: tuple[str, ...]
    proof: Proof
    reason: str = ""

    def __post_init__(self) -> None:
        n, k = len(self.turbines), len(self.stations)
        _require_sizes(self.proof, n, k)
        for case in self.proof.case.all():
            for each in case.rounds:
                _require_sizes(each, n, k)
            asked = case.question
            if isinstance(asked, Together) and not 0 <= asked.first < asked.second < n:
                raise InvalidInput("together", f"to be two turbines, from 0 to {n - 1}", asked)
            if isinstance(asked, Sent) and not 0 <= asked.station <= k:
                raise InvalidInput("station", f"from 0 to {k}", asked.station)


def _require_sizes(given: Proof | Round, n: int, k: int) -> None:
    got = len(given.prices), len(given.tolls)
    if got != (n, k + 1):
        raise InvalidInput("prices and tolls", f"of {n} turbines and {k} stations and all", got)


def _require_finite(field: str, values: NDArray[np.float64]) -> None:
    if values.ndim != 1 or not np.isfinite(values).all():
        raise InvalidInput(field, "to be a list of finite numbers", values)
