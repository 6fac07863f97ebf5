"""Dominance: what makes a partial flight useless.

A label at the same turbine that is no later, may visit no less, and is no dearer even after it
has paid for every cut that it is about to be charged for and the other is not [1].

* [1] Jepsen, Petersen, Spoorendonk & Pisinger (2008), *Operations Research* 56, 497-511.
"""

import numpy as np

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import EPS, Labels, Words, price_of
from windopt.solving.exact.network import Floats


@compiled
def dominated(
    T: float,
    C: float,
    V: np.uint64,
    S: Words,
    at: int,
    j: int,
    found: Labels,
    first_layer: int,
    last_layer: int,
    penalty: Floats,
    exact: bool,
) -> bool:
    """Tell whether a found label at j makes the one with parities ``S[at]`` useless."""
    for layer in range(first_layer, last_layer + 1):
        for a in range(found.start[layer, j], found.end[layer, j]):
            slack = C - found.C[a] + EPS
            if slack < 0.0:
                break
            if found.T[a] > T + EPS:
                continue
            if not exact:
                return True
            if found.V[a] & ~V != NONE:
                continue
            for word in range(S.shape[1]):
                slack -= price_of(found.S[a, word] & ~S[at, word], word, penalty)
                if slack < 0.0:
                    break
            if slack >= 0.0:
                return True
    return False
