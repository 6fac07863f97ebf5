"""Tables as plain text, for a terminal."""

from benchmarks.report.lines import Rows


def as_text(title: str, rows: Rows) -> str:
    """Return a table in columns."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = (
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    )
    return "\n".join([title, "-" * len(title), *lines])
