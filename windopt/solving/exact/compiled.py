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

    Structures of numbers pass for nothing then; one that holds arrays still counts its uses
    whenever an array is taken out of a structure within it, so nest none of these.
    """
    return cast(Function, nb.njit(inline="always", cache=True, nogil=True)(function))
