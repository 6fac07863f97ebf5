"""Options that are refused as they are read, by the rules and in the words of the library."""

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import typer

from windopt.errors import InvalidInput, require_one_of

Rule = Callable[[str, Any], None]
"""Called with the name of an option and its value; raises :class:`InvalidInput`."""


def checked(require: Rule) -> Callable[[typer.CallbackParam, Any], Any]:
    """Return the callback of an option that has to satisfy ``require`` where it has a value."""

    def check(option: typer.CallbackParam, value: Any) -> Any:
        if value is not None:
            require(option.opts[0], value)
        return value

    return check


def one_of(known: Iterable[str]) -> Rule:
    """Return the rule that a name is one of the ``known`` ones."""
    return partial(require_one_of, known=tuple(known))


def at_least(least: int) -> Rule:
    """Return the rule that a number is ``least`` or more."""

    def require(field: str, number: int) -> None:
        if not number >= least:
            raise InvalidInput(field, f">= {least}", number)

    return require


def within(least: float, most: float, unit: str = "") -> Rule:
    """Return the rule that a number lies between two others or is one of them."""

    def require(field: str, number: float) -> None:
        if not least <= number <= most:
            raise InvalidInput(field, f"from {least:g} to {most:g} {unit}".rstrip(), number)

    return require


require_direction = within(-360.0, 360.0, "deg")
"""The rule of directions that a person types; whatever lies beyond a turn is a slip of the pen."""
