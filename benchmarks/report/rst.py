"""The few forms of reStructuredText that the pages are made of."""

import csv
from collections.abc import Callable, Iterable, Sequence
from io import StringIO
from pathlib import Path

from benchmarks.case import Record


def title(text: str, line: str = "=") -> str:
    """Return a heading."""
    return f"{text}\n{line * len(text)}\n"


def table(caption: str, rows: Sequence[Sequence[str]]) -> str:
    """Return a table whose first row is its head."""
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    body = "".join(f"   {line}\n" for line in text.getvalue().splitlines())
    return f".. csv-table:: {caption}\n   :header-rows: 1\n\n{body}"


def filled(caption: str, rows: Sequence[Sequence[str]]) -> str:
    """Return a table, or nothing if it has no more than its head."""
    return table(caption, rows) if len(rows) > 1 else ""


def picture(draw: Callable[..., object], *drawn: object, path: Path, note: str = "") -> str:
    """Draw into a file, and return the picture over what the function that draws says of itself.

    A note follows it. Nothing is returned where there was nothing to draw.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4), layout="constrained")
    axes = figure.subplots()
    draw(*drawn, axes)
    if not axes.has_data():
        return ""
    figure.savefig(path, dpi=110, metadata={"Software": None})
    told = (draw.__doc__ or "").removeprefix("Draw ")
    caption = " ".join([*told.split(), *note.split()])
    alt = told.splitlines()[0]
    return f".. figure:: {path.name}\n   :alt: {alt}\n\n   {caption[:1].upper()}{caption[1:]}\n"


def origin(records: Iterable[Record]) -> str:
    """Return where the lines come from: commits, machines, versions, limits and commands."""
    lines = list(records)
    cases = {f"{len(lines)} cases": None}
    commits = dict.fromkeys(f"commit {line['commit']}" for line in lines)
    machines = dict.fromkeys(
        "{processor}, {processors} processors, {memory_gb} GB".format(**line["machine"])
        for line in lines
    )
    packages = dict.fromkeys(
        ", ".join(f"{name} {value}" for name, value in line["versions"].items() if name in SHOWN)
        for line in lines
    )
    limits = dict.fromkeys(f"limit {line['time_limit']:g} s, seed {line['seed']}" for line in lines)
    facts = [*cases, *commits, *machines, *packages, *limits]
    commands = dict.fromkeys(line["command"] for line in lines if line["command"])
    said = "".join(f"   $ {command}\n" for command in commands)
    listed = title(HEADING, "-") + "\n" + "".join(f"* {fact}\n" for fact in facts)
    return f"{listed}\n.. code-block:: console\n\n{said}" if said else listed


HEADING = "Where the lines come from"
SHOWN = "python", "numpy", "highspy", "numba", "casadi", "pyvrp", "ortools", "floris", "torch"
"""Packages whose versions the pages name."""
