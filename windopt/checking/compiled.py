"""Compiled loops of the checker; numba is loaded only when a certificate is verified."""

from collections.abc import Callable
from typing import TypeVar, cast

import numba as nb

Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function) -> Function:
    """Compile ``function`` when it is first called, and keep the result on disk."""
    return cast(Function, nb.njit(cache=True, nogil=True)(function))
