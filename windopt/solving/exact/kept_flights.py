"""Kept flights: the fastest over each set of turbines, hashed on the set."""

from typing import NamedTuple

import numpy as np

from windopt.solving.exact.bits import NONE, ONE
from windopt.solving.exact.compiled import compiled, inlined
from windopt.solving.exact.hashing import empty_slots, row_hash, same_rows
from windopt.solving.exact.labels import Ints, Words
from windopt.solving.exact.network import Floats


class Sets(NamedTuple):
    """Flights, one per set of turbines; the arrays are larger than the flights in use.

    Attributes
    ----------
    cost, station, ahead, behind
        Of each flight: its time, its station, and the halves it is joined from, or -1.
    set
        Its turbines as bits; the row after the last in use is scratch.
    """

    cost: Floats
    station: Ints
    ahead: Ints
    behind: Ints
    set: Words


@compiled
def _slot(slots: Ints, sets: Sets, row: int, apart: bool) -> np.uint64:
    """Return the slot of the turbines in ``row``, and of its station where these are ``apart``."""
    mask = np.uint64(len(slots) - 1)
    slot = row_hash(sets.set, row, sets.station[row] if apart else 0) & mask
    while slots[slot] >= 0:
        other = slots[slot]
        alike = not apart or sets.station[other] == sets.station[row]
        if alike and same_rows(sets.set, other, row):
            break
        slot = (slot + ONE) & mask
    return slot


@inlined
def record(
    sets: Sets, slots: Ints, count: int, cost: float, d: int, ahead: int, behind: int, apart: bool
) -> tuple[Ints, int, bool]:
    """Keep the flight whose turbines are in row ``count`` if it is the fastest of its set.

    Returns the hash table, the number of flights in use, and whether there was room.
    """
    sets.station[count] = d
    slot = _slot(slots, sets, count, apart)
    row = slots[slot]
    if row >= 0 and sets.cost[row] <= cost:
        return slots, count, True
    if row < 0:
        if count == len(sets.cost) - 1:
            return slots, count, False
        row = slots[slot] = count
        count += 1
        if 2 * count > len(slots):
            slots = empty_slots(4 * len(slots))
            for old in range(count):
                slots[_slot(slots, sets, old, apart)] = old
    sets.cost[row], sets.station[row], sets.ahead[row], sets.behind[row] = cost, d, ahead, behind
    return slots, count, True


@compiled
def unite(sets: Sets, count: int, a: Words, i: int, b: Words, j: int) -> None:
    """Write the turbines of two halves, or of one where j < 0, into row ``count``."""
    for word in range(sets.set.shape[1]):
        sets.set[count, word] = a[i, word] | (b[j, word] if j >= 0 else NONE)


@compiled
def disjoint(a: Words, i: int, b: Words, j: int) -> bool:
    """Tell whether two halves visit no turbine both."""
    common = NONE
    for word in range(a.shape[1]):
        common |= a[i, word] & b[j, word]
    return bool(common == NONE)
