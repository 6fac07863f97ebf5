"""Dataclasses of options: a command takes one whole, the command line each of its fields."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Any, get_type_hints


def unfolded(command: Callable[..., None]) -> Callable[..., None]:
    """Let a command be called with the fields of the dataclasses among its parameters.

    Parameters
    ----------
    command
        Each parameter that is annotated with a dataclass becomes that dataclass's fields, in
        order; their names must be distinct.
    """
    parameters = signature(command, eval_str=True).parameters
    kinds: dict[str, Any] = {name: each.annotation for name, each in parameters.items()}
    groups: dict[str, Any] = {name: kind for name, kind in kinds.items() if is_dataclass(kind)}
    flat: list[Parameter] = []
    for name, parameter in parameters.items():
        alone = parameter.replace(kind=Parameter.KEYWORD_ONLY)
        flat += _fields(groups[name]) if name in groups else [alone]

    @wraps(command)
    def run(**given: Any) -> None:
        made = {
            name: group(**{field.name: given.pop(field.name) for field in fields(group)})
            for name, group in groups.items()
        }
        command(**given, **made)

    run.__signature__ = Signature(flat)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in flat}
    return run


def _fields(group: Any) -> list[Parameter]:
    hints = get_type_hints(group, include_extras=True)
    return [
        Parameter(
            field.name, Parameter.KEYWORD_ONLY, default=field.default, annotation=hints[field.name]
        )
        for field in fields(group)
    ]
