"""Tables of single measurements: each row is shown as it comes, and kept in a CSV file."""

import csv
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path


def tabulate(rows: Iterable[Sequence[object]], out: Path | None = None) -> None:
    """Print each row once it is measured, and write it to a file where one is named.

    Parameters
    ----------
    rows
        The head of the table and what follows.
    out
        The file, which is replaced when all rows are there. Until then, and after an interrupt,
        they are in a file beside it whose name ends in ``.part``.
    """
    part = out.with_name(f"{out.name}.part") if out else None
    with ExitStack() as stack:
        file = stack.enter_context(part.open("w", newline="", encoding="utf-8")) if part else None
        for row in rows:
            print("  ".join(map(str, row)), flush=True)
            if file is not None:
                csv.writer(file, lineterminator="\n").writerow(row)
                file.flush()
    if part is not None and out is not None:
        part.replace(out)
