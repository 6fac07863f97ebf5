"""What a search may be asked for, refused in the same words wherever it enters."""

from numbers import Real

from windopt.errors import InvalidInput

LEAST_MEMORY = 1e8
"""The least that the lists of an exact search may be given [bytes]."""


def require_gap(field: str, gap: object) -> None:
    """Raise unless a relative gap to stop at is at least 0 and below 1 [-].

    Between any plan and the bound 0 the gap is 1, so that it would ask for nothing.
    """
    if not (isinstance(gap, Real) and 0 <= float(gap) < 1):
        raise InvalidInput(field, ">= 0 and < 1", gap)


def require_memory(field: str, memory: object) -> None:
    """Raise unless a search has the memory it needs at least [bytes]."""
    if not (isinstance(memory, Real) and float(memory) >= LEAST_MEMORY):
        raise InvalidInput(field, f"of at least {LEAST_MEMORY:,.0f} bytes", memory)
