"""Hash tables of sets: rows of words, found again by open addressing.

A table is an array of row numbers, a power of two long, with -1 where it is free.
"""

import numpy as np

from windopt.solving.exact.bits import NONE
from windopt.solving.exact.compiled import compiled
from windopt.solving.exact.labels import Ints, Words


@compiled
def row_hash(words: Words, row: int, salt: int) -> np.uint64:
    """Mix a row of words."""
    mixed = np.uint64(salt) * np.uint64(0xC2B2AE3D27D4EB4F)
    for word in range(words.shape[1]):
        mixed ^= words[row, word]
        mixed ^= mixed >> np.uint64(29)
        mixed *= np.uint64(0xBF58476D1CE4E5B9)
        mixed ^= mixed >> np.uint64(32)
        mixed *= np.uint64(0x94D049BB133111EB)
    return mixed ^ (mixed >> np.uint64(31))


@compiled
def same_rows(words: Words, a: int, b: int) -> bool:
    differing = NONE
    for word in range(words.shape[1]):
        differing |= words[a, word] ^ words[b, word]
    return bool(differing == NONE)


@compiled
def empty_slots(size: int) -> Ints:
    return np.full(size, -1, np.int32)
