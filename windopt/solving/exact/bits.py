"""Sets as bits of unsigned words, for the compiled loops."""

import numpy as np

from windopt.solving.exact.compiled import compiled

NONE = np.uint64(0)
ONE = np.uint64(1)

# A de Bruijn sequence: multiplied by a power of two, its top six bits tell which power.
_SEQUENCE = 0x03F79D71B4CB0A89
_POSITION = np.zeros(64, np.int64)
for _power in range(64):
    _POSITION[((_SEQUENCE << _power) & (2**64 - 1)) >> 58] = _power
_SEQUENCE_WORD = np.uint64(_SEQUENCE)
_SHIFT = np.uint64(58)


@compiled
def position(lowest: np.uint64) -> int:
    """Return which bit is set in a word that has one."""
    return _POSITION[(lowest * _SEQUENCE_WORD) >> _SHIFT]  # type: ignore[no-any-return]


@compiled
def bit(i: int) -> np.uint64:
    """Return the bit of element i within its word."""
    return ONE << np.uint64(i & 63)
