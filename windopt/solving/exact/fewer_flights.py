"""Fewer flights: those of one station that are one flight at no greater cost become one.

Only time is paid for, so that a search does not mind a flight too many where a station stands at a
turbine; whoever flies does.
"""

from collections.abc import Sequence
from itertools import permutations

from windopt.solving.exact.network import SLACK, Network
from windopt.solving.exact.search import Flight

SAME = 1e-9
"""Times this close are the same, in thousandths of the longest t_max."""


def fewer_flights(flights: Sequence[Flight], networks: list[Network]) -> list[Flight]:
    """Join flights end to end as long as that costs nothing and is in time."""
    left = list(flights)
    while pair := _joinable(left, networks):
        ahead, behind = pair
        left.remove(ahead)
        left.remove(behind)
        left.append((ahead[0], ahead[1] + behind[1]))
    return left


def _joinable(flights: Sequence[Flight], networks: list[Network]) -> tuple[Flight, Flight] | None:
    """Return two flights that may be flown as one, in their order."""
    for ahead, behind in permutations(flights, 2):
        network = networks[ahead[0]]
        if ahead[0] == behind[0]:
            apart = network.duration(ahead[1]) + network.duration(behind[1])
            whole = network.duration(ahead[1] + behind[1])
            if whole <= min(apart + SAME, network.t_max + SLACK):
                return ahead, behind
    return None
