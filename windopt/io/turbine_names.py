"""Names for turbines whose source leaves some of them nameless or gives a name twice."""

from collections.abc import Sequence
from itertools import chain, count


def distinct_names(labels: Sequence[str | None]) -> tuple[list[str], tuple[str, ...]]:
    """Return a distinct name for each label, and notes on the names that were made up.

    A turbine without a label is called by its place in the source, ``T01``, ``T02``...; the second
    one of a label is called ``label (2)``, the third ``label (3)``.

    Parameters
    ----------
    labels
        As the source gives them, in its order.
    """
    width = max(2, len(str(len(labels))))
    given = [(label or "").strip() for label in labels]
    names: list[str] = []
    taken: set[str] = set()
    for place, label in enumerate(given, start=1):
        stem = label or f"T{place:0{width}}"
        candidates = chain([stem], (f"{stem} ({k})" for k in count(2)))
        reserved = set(given) - {label}
        names.append(next(c for c in candidates if c not in taken and c not in reserved))
        taken.add(names[-1])

    numbered = given.count("")
    repeated = [name for name, label in zip(names, given, strict=True) if label not in ("", name)]
    notes = []
    if numbered:
        notes.append(f"Turbines without a name, numbered in the source's order: {numbered}.")
    if repeated:
        notes.append(f"Names given twice, told apart: {', '.join(repeated[:5])}.")
    return names, tuple(notes)
