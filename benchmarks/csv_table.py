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
        The file; after an interrupt it holds the rows until then.
    """
    with ExitStack() as stack:
        file = stack.enter_context(out.open("w", newline="", encoding="utf-8")) if out else None
        for row in rows:
            print("  ".join(map(str, row)), flush=True)
            if file is not None:
                csv.writer(file, lineterminator="\n").writerow(row)
                file.flush()
