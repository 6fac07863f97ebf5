"""Screening: flights left out of a list by the prices of the list before.

Prices bound plans however they were found: a plan takes their value and the reduced costs of its
flights. Where these fall below zero by little, a plan cheaper than a target flies only flights
whose reduced cost is what is left up to the target and that little. The prices of a list count its
rows in full, which labels cannot afford, and leave out most flights that the prices of labels let
pass; those left out are made and looked at one by one, but never held.

No list tells how far flights beyond it fall below zero by its prices. A mix with prices of labels,
by which no flight does, keeps them above it, or not much below.

Rows are priced for 64 of them at a time: the sums of weights are counters of five bits, kept as
five words, which begin at 16 less what the row asks for, so that the highest bit tells.
"""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from windopt.solving.exact.bits import NONE, ONE, position
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.half_flights import Halves
from windopt.solving.exact.labels import Words, price_of
from windopt.solving.exact.master import Duals
from windopt.solving.exact.network import Bools, Floats
from windopt.solving.exact.rank_one_rows import BITS, LARGEST, Ints64, Rows
from windopt.solving.exact.subset_row_cuts import Path, packed

HIGHEST = 1 << (BITS - 1)
"""The value of a counter's highest bit, more than any row asks for."""


class RowDuals(NamedTuple):
    """Duals, and the row of each penalty, which counts in full."""

    duals: Duals
    rows: Rows


def mixed(share: float, one: RowDuals, other: RowDuals) -> RowDuals:
    """Return ``share`` of one and the rest of another; its value is the mix of theirs."""
    rest = 1.0 - share
    (a, rows), (b, other_rows) = one, other
    duals = Duals(
        share * a.pi + rest * b.pi,
        share * a.sigma + rest * b.sigma,
        np.concatenate([share * a.penalty, rest * b.penalty]),
        np.concatenate([share * a.reward, rest * b.reward]),
        a.crowded.joined(b.crowded),
    )
    return RowDuals(duals, rows.joined(other_rows))


def together_below(reduced: Floats, members: Bools) -> float:
    """Return how far flights of one plan fall below zero together, at most.

    Each turbine is on one of them, so it lends no more than the largest part of a flight.

    Parameters
    ----------
    reduced
        All reduced costs below zero, shape ``(m,)``.
    members
        Whether each flight visits each turbine, shape ``(m, n)``.
    """
    parts = -reduced / members.sum(axis=1)
    return float((members * parts[:, None]).max(axis=0, initial=0.0).sum())


@dataclass(frozen=True)
class Screen:
    """Prices, and the reduced cost by these that flights of interest do not exceed.

    Parameters
    ----------
    prices
        Of any flights.
    limit
        Of the reduced cost, not negative.
    """

    prices: RowDuals
    limit: float

    def reduced_cost(self, station: int, path: Path, time: float) -> float:
        """Return the reduced cost of a flight without cycles."""
        duals, rows = self.prices
        members = np.zeros((1, len(duals.pi)), bool)
        members[0, list(path)] = True
        entered = duals.reward[(duals.crowded.sets & members).any(axis=1)].sum()
        penalty = rows.coefficients(members)[0] @ duals.penalty
        return float(time - duals.pi[list(path)].sum() - duals.toll[station] - entered + penalty)


class ListPrices(NamedTuple):
    """What the duals of a screen ask of a flight from any station.

    A row that a flight may exceed several times counts as several, one for each time.

    Attributes
    ----------
    pi
        Reward of each turbine, shape ``(n,)``.
    crowded, reward
        Crowded sets as bits, shape ``(sets, words)``, and what entering each earns.
    price
        Of each row, dearest first, shape ``(64 words,)``.
    odd, even
        The lower and the higher bit of each turbine's weight in each row, shape ``(n, words)``.
    start
        Where the counters begin, shape ``(5, words)``.
    """

    pi: Floats
    crowded: Words
    reward: Floats
    price: Floats
    odd: Words
    even: Words
    start: Words

    @classmethod
    def of(cls, screen: Screen | None, n: int) -> Self:
        """Return the prices of a screen; of none where there is none."""
        if screen is None:
            nothing, no_rows = np.zeros(0), np.zeros((n, 0), np.uint64)
            no_sets, no_counters = (np.zeros((rows, 0), np.uint64) for rows in (0, BITS))
            return cls(np.zeros(n), no_sets, nothing, nothing, no_rows, no_rows, no_counters)
        duals = screen.prices.duals
        rows, asked, price = _each_time(screen.prices)
        weight = np.zeros((n, rows.m), np.int64)
        for q in range(LARGEST):
            np.add.at(weight, (rows.turbines[:, q], np.arange(rows.m)), rows.weight[:, q])
        start = HIGHEST - asked
        padded = np.zeros(64 * -(-rows.m // 64))
        padded[: rows.m] = price
        earning = duals.reward > 0.0
        return cls(
            duals.pi,
            packed(duals.crowded.sets[earning]),
            duals.reward[earning],
            padded,
            packed((weight & 1).astype(bool)),
            packed((weight >> 1).astype(bool)),
            packed(np.array([start >> b & 1 for b in range(BITS)], bool)),
        )


def _each_time(prices: RowDuals) -> tuple[Rows, Ints64, Floats]:
    """Return each row as often as a flight may exceed it, what it asks for then, and its price."""
    penalty, rows = prices.duals.penalty, prices.rows
    often = [np.flatnonzero((rows.right >= level) & (penalty > 0.0)) for level in (1, 2)]
    level = np.repeat([1, 2], [len(each) for each in often])
    row = np.concatenate(often)
    price = penalty[row] / rows.right[row]
    order = np.argsort(-price, kind="stable")
    row, level = row[order], level[order]
    asked = level * rows.divisor[row]
    return rows.kept(row), asked, price[order]


class Looks(NamedTuple):
    """What half flights cost by the prices of a list.

    Attributes
    ----------
    time
        Their time, less the rewards of their turbines.
    alone
        The same, less what sets earn and with the penalties of rows that the half pays by itself:
        two halves together cost no less than both.
    """

    time: Floats
    alone: Floats


@compiled
def looked_at(halves: Halves, prices: ListPrices) -> Looks:
    """Price half flights."""
    m, words = len(halves.T), prices.odd.shape[1]
    looks, inside = Looks(np.empty(m), np.empty(m)), np.empty(len(prices.pi), np.int64)
    counter = np.empty((BITS, words), np.uint64)
    for half in range(m):
        size = turbines_of(halves.set, half, inside)
        cost = halves.T[half]
        for q in range(size):
            cost -= prices.pi[inside[q]]
        looks.time[half] = cost
        count_weights(prices, inside, size, counter)
        for word in range(words):
            cost += price_of(counter[BITS - 1, word], word, prices.price)
        looks.alone[half] = cost - earned(prices, halves.set, half)
    return looks


@compiled
def turbines_of(sets: Words, row: int, inside: Ints64) -> int:
    """Write the turbines of a set into ``inside``, and return how many they are."""
    size = 0
    for word in range(sets.shape[1]):
        bits = sets[row, word]
        while bits != NONE:
            lowest = bits & (~bits + ONE)
            bits ^= lowest
            inside[size] = 64 * word + position(lowest)
            size += 1
    return size


@compiled
def earned(prices: ListPrices, sets: Words, row: int) -> float:
    """Return what a flight over a set of turbines earns by entering crowded sets."""
    total = 0.0
    for each in range(len(prices.reward)):
        common = NONE
        for word in range(sets.shape[1]):
            common |= sets[row, word] & prices.crowded[each, word]
        if common != NONE:
            total += prices.reward[each]
    return total


@compiled
def count_weights(prices: ListPrices, inside: Ints64, size: int, counter: Words) -> None:
    """Write the counters of a set of turbines into ``counter``."""
    counter[:] = prices.start
    for word in range(counter.shape[1]):
        for q in range(size):
            carry = prices.odd[inside[q], word]
            for b in range(BITS):
                counter[b, word], carry = counter[b, word] ^ carry, counter[b, word] & carry
            carry = prices.even[inside[q], word]
            for b in range(1, BITS):
                counter[b, word], carry = counter[b, word] ^ carry, counter[b, word] & carry


@compiled
def exceeds(
    prices: ListPrices, counter: Words, inside: Ints64, size: int, cost: float, limit: float
) -> bool:
    """Tell whether a flight exceeds ``limit`` once it has paid for rows.

    Parameters
    ----------
    counter
        The counters of a part of it.
    inside, size
        The turbines of the other part.
    cost
        What it costs without rows.
    """
    if cost > limit:
        return True
    for word in range(counter.shape[1]):
        c0, c1, c2 = counter[0, word], counter[1, word], counter[2, word]
        c3, c4 = counter[3, word], counter[4, word]
        for q in range(size):
            carry = prices.odd[inside[q], word]
            c0, carry = c0 ^ carry, c0 & carry
            more = prices.even[inside[q], word]
            c1, carry, more = c1 ^ carry ^ more, (c1 & (carry | more)) | (carry & more), NONE
            c2, carry = c2 ^ carry, c2 & carry
            c3, carry = c3 ^ carry, c3 & carry
            c4 |= carry
        cost += price_of(c4, word, prices.price)
        if cost > limit:
            return True
    return False
