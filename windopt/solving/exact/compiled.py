"""Compiled loops: numba, with what it compiled kept on disk and Python's lock let go."""

from collections.abc import Callable
from typing import TypeVar, cast

import numba as nb

Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """Compile ``function`` when it is first called."""
    return cast(Function, nb.njit(cache=True, nogil=True)(function))
