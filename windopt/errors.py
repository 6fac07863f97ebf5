"""What windopt says when an input cannot be used."""

from collections.abc import Iterable, Sequence
from reprlib import repr as shortened


class InvalidInput(ValueError):  # noqa: N818  (it is a ValueError, and reads as one)
    """An input that cannot be used: which field, what was expected and what came.

    Parameters
    ----------
    field
        Name of the offending field, as the user knows it: a column, a key, an option.
    expected
        What would have been accepted, as the end of "Expected <field> ...".
    got
        What came instead.
    """

    def __init__(self, field: str, expected: str, got: object) -> None:
        super().__init__(f"Expected {field} {expected}, got {got}.")
        self.field = field
        self.expected = expected
        self.got = got


def require_kind(field: str, value: object, kind: type) -> None:
    """Raise unless ``value`` is a ``kind``: a farm, say, and not the name of one."""
    if not isinstance(value, kind):
        raise InvalidInput(field, f"to be a {kind.__name__}", shortened(value))


def require_one_of(field: str, name: object, known: Iterable[str]) -> None:
    """Raise unless ``name`` is one of the ``known`` ones."""
    known = tuple(known)
    if name not in known:
        raise InvalidInput(field, f"to be one of {', '.join(known)}", repr(name))


def listed(names: Sequence[str], most: int = 5) -> str:
    """Return the first names, and how many more there are: A1, A2 and 7 more."""
    told = ", ".join(names[:most])
    return told if len(names) <= most else f"{told} and {len(names) - most} more"


class MissingExtra(ImportError):  # noqa: N818
    """An optional dependency that is not installed, and the command that installs it."""

    def __init__(self, feature: str, extra: str) -> None:
        super().__init__(f"{feature} needs an extra: pip install 'windopt[{extra}]'.")
        self.extra = extra


class FailedCheck(RuntimeError):  # noqa: N818
    """A plan that its maker held to be sound and the independent checker does not."""

    def __init__(self, violations: tuple[str, ...]) -> None:
        super().__init__("The plan fails its check and is withheld: " + "; ".join(violations[:5]))
        self.violations = violations
