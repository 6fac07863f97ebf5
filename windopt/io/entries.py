"""One entry of a nested document (YAML or JSON), and the path of keys that leads to it.

Readers ask an entry for what they need; what is missing or of another kind raises
:class:`~windopt.errors.InvalidInput` with the path, such as ``layouts[0].coordinates.x[3]``.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from typing import Any

from windopt.errors import InvalidInput

KINDS: dict[type, str] = {dict: "a mapping", list: "a list"}


@dataclass(frozen=True)
class Entry:
    """A value, and where it stands.

    Parameters
    ----------
    value
        As the document's parser gives it.
    path
        Keys from the document's top down to it.
    """

    value: Any
    path: str = ""

    def refuse(self, expected: str) -> InvalidInput:
        """Return the complaint that this entry should have been something else."""
        kind = next((kind for kind in KINDS if isinstance(self.value, kind)), None)
        shown = KINDS[kind] if kind else repr(self.value)
        shown = shown if len(shown) <= 60 else shown[:60] + "..."
        return InvalidInput(self.path or "the document", expected, shown)

    def __contains__(self, key: str) -> bool:
        """Tell whether this mapping gives ``key`` a value other than null."""
        return isinstance(self.value, dict) and self.value.get(key) is not None

    def __getitem__(self, key: str) -> "Entry":
        """Return the entry under ``key`` of this mapping."""
        if not isinstance(self.value, dict):
            raise self.refuse("to be a mapping")
        path = f"{self.path}.{key}" if self.path else str(key)
        if key not in self.value:
            raise InvalidInput(path, "to be given", "nothing")
        return Entry(self.value[key], path)

    def nullable(self, key: str) -> "Entry | None":
        """Return the entry under ``key`` of this mapping, or ``None`` where it is null."""
        entry = self[key]
        return None if entry.value is None else entry

    def __iter__(self) -> Iterator["Entry"]:
        """Iterate over the entries of this list."""
        if not isinstance(self.value, list):
            raise self.refuse("to be a list")
        return (Entry(value, f"{self.path}[{i}]") for i, value in enumerate(self.value))

    def items(self) -> Iterator[tuple[str, "Entry"]]:
        """Iterate over keys and entries of this mapping."""
        if not isinstance(self.value, dict):
            raise self.refuse("to be a mapping")
        return ((str(key), Entry(v, f"{self.path}.{key}")) for key, v in self.value.items())

    @property
    def number(self) -> float:
        """The value, a finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            raise self.refuse("to be a number")
        try:
            number = float(self.value)
        except OverflowError:
            number = float("inf")
        if not isfinite(number):
            raise self.refuse("to be a finite number")
        return number

    @property
    def numbers(self) -> list[float]:
        """The values of a list of finite numbers."""
        return [entry.number for entry in self]

    @property
    def text(self) -> str:
        """The value, a text."""
        if not isinstance(self.value, str):
            raise self.refuse("to be a text")
        return self.value

    @property
    def label(self) -> str:
        """The value, a text or a whole number, as a text."""
        return str(self.value) if type(self.value) is int else self.text

    @property
    def texts(self) -> list[str]:
        """The values of a list of texts."""
        return [entry.text for entry in self]

    @property
    def truth(self) -> bool:
        """The value, true or false."""
        if not isinstance(self.value, bool):
            raise self.refuse("to be true or false")
        return self.value
