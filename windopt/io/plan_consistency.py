"""What a record of a plan says twice, held against itself.

Beside what a plan is rebuilt from, a record carries what follows from it, for people: the speed of
a wind beside its velocity, the power of a farm beside that of its turbines. Whoever edits one
without the other is told so.
"""

from collections.abc import Iterator
from math import isclose
from typing import Any

from windopt.domain.plan import Plan
from windopt.io.plan_reader import plan_from_record
from windopt.io.plans import record_of

ROUNDING = 1e-9
"""Relative, and absolute near 0; a record's numbers come back to some 1e-12."""


def inconsistencies(document: Any) -> tuple[str, ...]:
    """Return what a record says otherwise than the plan rebuilt from it, a sentence each.

    Parameters
    ----------
    document
        As parsed from JSON.

    Raises
    ------
    InvalidInput
        Naming the key that is missing or cannot be used.
    """
    plan = plan_from_record(document)
    if isinstance(plan, Plan) and len(plan.yaw) != len(plan.forecast):
        return ()  # There is no such record; `windopt.check` counts the steps.
    expected = record_of(plan)
    del expected["farm"]  # It says nothing twice, and names its turbine types as it likes.
    return tuple(_differences(document, expected, ""))


def _differences(said: Any, expected: Any, path: str) -> Iterator[str]:
    if isinstance(expected, dict):
        for key, value in expected.items():
            place = f"{path}.{key}" if path else key
            if key in said:
                yield from _differences(said[key], value, place)
            else:
                yield f"{place} is not said, {value!r} is found"
    elif isinstance(expected, list):
        for i, (one, other) in enumerate(zip(said, expected, strict=True)):
            yield from _differences(one, other, f"{path}[{i}]")
    elif not _same(said, expected):
        yield f"{path} is said to be {said!r}, {expected!r} is found"


def _same(said: Any, expected: Any) -> bool:
    numbers = isinstance(expected, float) and isinstance(said, int | float)
    if not numbers or isinstance(said, bool):
        return bool(said == expected)
    try:
        return isclose(said, expected, rel_tol=ROUNDING, abs_tol=ROUNDING)
    except OverflowError:  # a whole number beyond any float
        return False
