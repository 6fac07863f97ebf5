"""A plan at once: flights to one turbine each, made one where that saves most.

These are Clarke and Wright's savings [1] with several stations: pairs of turbines are tried in the
order of what one flight to both saves, from the best station for it, and flights may be turned
round. Nothing here is compiled, so that a search has a plan worth flying from its first moment,
on a machine's first use too.

* [1] Clarke & Wright (1964), *Operations Research* 12, 568-581.
"""

from collections.abc import Iterator

import numpy as np

from windopt.solving.exact.network import SLACK, Floats, Network
from windopt.solving.exact.search import Flight, alone


def savings(networks: list[Network], most: Floats, prize: Floats) -> list[Flight]:
    """Return flights that keep every limit, and visit all turbines where flights are not few.

    Parameters
    ----------
    most
        Most flights of each station, shape ``(k,)``.
    prize
        Cost of leaving each turbine out, shape ``(n,)``.
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
    for i, j in _pairs(networks, lone):
        if i not in ending or j not in ending or ending[i] is ending[j]:
            continue
        (d, ahead), (e, behind) = ending[i], ending[j]
        apart = networks[d].duration(ahead) + networks[e].duration(behind)
        path = ahead if ahead[-1] == i else ahead[::-1]
        path += behind if behind[0] == j else behind[::-1]
        ways = ((s, way) for s in (d, e) for way in (path, path[::-1]))
        times = ((networks[s].duration(way), s, way) for s, way in ways)
        fitting = (each for each in times if each[0] <= networks[each[1]].t_max + SLACK)
        time, station, path = min(fitting, default=(apart, d, ahead))
        if time < apart:
            for end in (ahead[0], ahead[-1], behind[0], behind[-1]):
                ending.pop(end, None)
            ending[path[0]] = ending[path[-1]] = station, path
    return [(station, path) for end, (station, path) in ending.items() if end == path[0]]


def _pairs(networks: list[Network], lone: list[Flight]) -> Iterator[tuple[int, int]]:
    """Yield turbines to visit one after the other, those first whose flights joined save most."""
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
    yield from zip(turbines[first].tolist(), turbines[second].tolist(), strict=True)
