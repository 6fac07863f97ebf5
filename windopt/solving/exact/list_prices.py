"""List prices: what duals of a list, or a mix of them, ask of a flight.

Rows are priced for 64 of them at a time: the sums of weights are counters of five bits, kept as
five words, one for each bit, and begin at 16 less what the row asks for, so that the highest bit
tells.
"""

from typing import NamedTuple, Self

import numpy as np

from windopt.solving.exact.bits import NONE, ONE, position
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.half_flights import Halves
from windopt.solving.exact.labels import Words, price_of
from windopt.solving.exact.network import Floats
from windopt.solving.exact.rank_one_rows import BITS, HIGHEST, LARGEST, Ints64
from windopt.solving.exact.row_duals import RowDuals
from windopt.solving.exact.subset_row_cuts import packed


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
    ones, twos
        The lower and the higher bit of each turbine's weight in each row, shape ``(n, words)``.
    start
        Where the counters begin, shape ``(5, words)``.
    """

    pi: Floats
    crowded: Words
    reward: Floats
    price: Floats
    ones: Words
    twos: Words
    start: Words

    @classmethod
    def of(cls, prices: RowDuals | None, n: int) -> Self:
        """Return what ``prices`` ask, and nothing where there are none, of n turbines."""
        if prices is None:
            nothing, no_rows = np.zeros(0), np.zeros((n, 0), np.uint64)
            no_sets, no_counters = (np.zeros((rows, 0), np.uint64) for rows in (0, BITS))
            return cls(np.zeros(n), no_sets, nothing, nothing, no_rows, no_rows, no_counters)
        duals, rows = prices
        row, asked, price = _each_time(prices)
        rows = rows.kept(row)
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


def _each_time(prices: RowDuals) -> tuple[Ints64, Ints64, Floats]:
    """Return each row as often as a flight may exceed it, what it asks for then, and its price."""
    penalty, right = prices.duals.penalty, prices.rows.right
    times = range(1, int(right.max(initial=0)) + 1)
    often = [np.flatnonzero((right >= time) & (penalty > 0.0)) for time in times]
    time = np.repeat(np.arange(len(often)) + 1, [len(each) for each in often])
    row = np.concatenate([*often, np.zeros(0, np.int64)])
    price = penalty[row] / right[row]
    dearest = np.argsort(-price, kind="stable")
    row, time = row[dearest], time[dearest]
    return row, time * prices.rows.divisor[row], price[dearest]


class Looks(NamedTuple):
    """What half flights cost by the prices of a list.

    Attributes
    ----------
    time
        Their time, less the rewards of their turbines.
    alone
        The same, less what crowded sets earn and with the penalties of rows that the half pays by
        itself: two halves together cost no less than both.
    """

    time: Floats
    alone: Floats


@compiled
def looked_at(halves: Halves, prices: ListPrices) -> Looks:
    """Price half flights."""
    m, words = len(halves.T), prices.ones.shape[1]
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


@inlined
def _counted(counter: Words, word: int, carry: np.uint64, lowest: int) -> None:
    """Add a bit to 64 counters, from the bit ``lowest`` upwards."""
    for b in range(lowest, BITS):
        counter[b, word], carry = counter[b, word] ^ carry, counter[b, word] & carry


@compiled
def count_weights(prices: ListPrices, inside: Ints64, size: int, counter: Words) -> None:
    """Write the counters of a set of turbines into ``counter``."""
    counter[:] = prices.start
    for word in range(counter.shape[1]):
        for q in range(size):
            _counted(counter, word, prices.ones[inside[q], word], 0)
            _counted(counter, word, prices.twos[inside[q], word], 1)


@compiled
def exceeds(
    prices: ListPrices, counter: Words, inside: Ints64, size: int, cost: float, limit: float
) -> bool:
    """Tell whether a flight exceeds ``limit`` once it has paid for rows.

    The counters stand in variables here: this is done for each flight that is joined.

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
            carry = prices.ones[inside[q], word]
            c0, carry = c0 ^ carry, c0 & carry
            more = prices.twos[inside[q], word]
            c1, carry = c1 ^ carry ^ more, (c1 & (carry | more)) | (carry & more)
            c2, carry = c2 ^ carry, c2 & carry
            c3, carry = c3 ^ carry, c3 & carry
            c4 |= carry
        cost += price_of(c4, word, prices.price)
        if cost > limit:
            return True
    return False
