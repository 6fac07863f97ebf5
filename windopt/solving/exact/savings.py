"""A plan at once: flights to one turbine each, made one where that saves most.

These are Clarke and Wright's savings [1] with several stations: pairs of turbines are tried in the
order of what one flight to both saves, from the best station for it, and flights may be turned
round. Nothing here is compiled, so that a search has a plan worth flying from its first moment,
on a machine's first use too.

* [1] Clarke & Wright (1964), *Operations Research* 12, 568-581.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from windopt.solving.exact.network import SLACK, Floats, Network
from windopt.solving.exact.search import Flight, alone

AT_ONCE = 4096
"""Pairs of turbines of which those within a flight are dropped together."""


def savings(networks: list[Network], most: Floats, prize: Floats) -> list[Flight]:
    """Return flights that keep every limit, and visit all turbines where flights are not few.

    Parameters
    ----------
    networks
        Of the stations; their unit of time is that of the prizes.
    most
        Most flights of each station, shape ``(k,)``; ``inf`` where there is no limit.
    prize
        Cost of leaving each turbine out, shape ``(n,)``; ``inf`` where it must be inspected.
    """
    flights = _joined(networks)
    worth = [prize[list(path)].sum() - networks[d].duration(path) for d, path in flights]
    left, kept = most.copy(), []
    for r in np.argsort(worth)[::-1]:
        d = flights[r][0]
        if worth[r] > 0.0 and left[d] > 0.0:
            kept.append(flights[r])
            left[d] -= 1.0
    return kept


def _joined(networks: list[Network]) -> list[Flight]:
    """Join flights at their ends, turned round where need be, as long as that saves time."""
    lone = alone(networks)
    ending = {path[0]: (d, path) for d, path in lone}  # the flight that begins or ends at each
    for pairs in _pairs(networks, lone):
        ends = np.isin(pairs, list(ending)).all(axis=1)  # most turbines soon lie within a flight
        for i, j in pairs[ends].tolist():
            if i not in ending or j not in ending or ending[i] is ending[j]:
                continue
            ahead, behind = ending[i], ending[j]
            if whole := _whole(networks, ahead, behind, i, j):
                for end in (ahead[1][0], ahead[1][-1], behind[1][0], behind[1][-1]):
                    ending.pop(end, None)
                ending[whole[1][0]] = ending[whole[1][-1]] = whole
    return [(station, path) for end, (station, path) in ending.items() if end == path[0]]


def _whole(nets: list[Network], ahead: Flight, behind: Flight, i: int, j: int) -> Flight | None:
    """Return the fastest flight of two, joined by the leg from i to j, if that saves time."""
    (d, path), (e, rest) = ahead, behind
    apart = nets[d].duration(path) + nets[e].duration(rest)
    joint = path if path[-1] == i else path[::-1]
    joint += rest if rest[0] == j else rest[::-1]
    ways = ((s, way) for s in (d, e) for way in (joint, joint[::-1]))
    times = ((nets[s].duration(way), s, way) for s, way in ways)
    fitting = (each for each in times if each[0] <= nets[each[1]].t_max + SLACK)
    time, station, fastest = min(fitting, default=(apart, d, path))
    return (station, fastest) if time < apart else None


def _pairs(networks: list[Network], lone: list[Flight]) -> Iterator[NDArray[np.intp]]:
    """Yield turbines to visit one after the other, some pairs at a time, shape ``(m, 2)``.

    Those come first whose flights joined save most.
    """
    turbines = np.array([i for _, (i,) in lone], np.intp)
    apart = np.array([networks[d].duration(path) for d, path in lone])
    joint = np.full((len(lone), len(lone)), np.inf)
    for network in networks:
        legs = network.legs[np.ix_(turbines, turbines)]
        time = network.out[turbines, None] + legs + network.back[None, turbines]
        joint = np.where(time <= network.t_max + SLACK, np.minimum(joint, time), joint)
    saved = apart[:, None] + apart[None, :] - joint
    order = np.argsort(-saved, axis=None, kind="stable")[: int((saved > 0.0).sum())]
    first, second = np.unravel_index(order, saved.shape)
    pairs = np.column_stack([turbines[first], turbines[second]])
    for begin in range(0, len(pairs), AT_ONCE):
        yield pairs[begin : begin + AT_ONCE]
