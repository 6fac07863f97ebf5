"""Compiled loops: numba, with what it compiled kept on disk and Python's lock let go."""

from collections.abc import Callable
from typing import TypeVar, cast

import numba as nb

Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """Compile ``function`` when it is first called."""
    return cast(Function, nb.njit(cache=True, nogil=True)(function))


def inlined(function: Function) -> Function:
    """Compile ``function`` into those that call it, where a call would cost more than its work.

    Passing tuples of numbers costs nothing then. Do not nest tuples that hold arrays: numba counts
    a reference whenever one is taken out.
    """
    return cast(Function, nb.njit(inline="always", cache=True, nogil=True)(function))
