"""CSV files as columns of text, whose numbers are read with the line they stand on."""

import csv
import gzip
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import StringIO
from itertools import islice
from pathlib import Path
from zlib import error as ZlibError  # noqa: N812  (zlib names it in lower case)

import numpy as np
from numpy.typing import NDArray

from windopt.errors import InvalidInput

MAX_BYTES = 10**9
CHUNK = 10_000  # rows; few enough that Python's collector of garbage has little to look through
MISSING = frozenset({"", "-", "na", "n/a", "nan", "nat", "none", "null"})


@dataclass(frozen=True)
class Column:
    """One column of a file.

    Parameters
    ----------
    name
        As the header gives it.
    cells
        Its texts, without surrounding blanks.
    lines
        The line of the file on which each cell stands, from 1.
    """

    name: str
    cells: Sequence[str]
    lines: Sequence[int]

    def refuse(self, row: int, expected: str) -> InvalidInput:
        """Return the complaint about one cell."""
        cell = self.cells[row]
        shown = repr(cell if len(cell) <= 40 else cell[:40] + "...")
        return InvalidInput(f"{self.name!r} in line {self.lines[row]}", expected, shown)

    def names(self) -> list[str]:
        """Return the cells, none of which may be empty."""
        if "" in self.cells:
            raise self.refuse(self.cells.index(""), "to be a name")
        return list(self.cells)

    def numbers(self, *, missing: bool = False) -> NDArray[np.float64]:
        """Return the cells as finite numbers, or NaN where ``missing`` ones are allowed."""
        texts = self.cells
        if missing:
            texts = ["nan" if text.lower() in MISSING else text for text in texts]
        try:
            numbers = np.fromiter(map(float, texts), float, len(texts))
        except ValueError:
            row = next(row for row, text in enumerate(texts) if not _is_number(text))
            raise self.refuse(row, "to be a number") from None
        wrong = np.isinf(numbers) if missing else ~np.isfinite(numbers)
        if wrong.any():
            raise self.refuse(int(wrong.argmax()), "to be a finite number")
        return numbers

    def positive(self, unit: str, *, missing: bool = False) -> NDArray[np.float64]:
        """Return the cells as positive numbers; ``unit`` is for the complaint."""
        numbers = self.numbers(missing=missing)
        if (numbers <= 0).any():
            raise self.refuse(int((numbers <= 0).argmax()), f"> 0 {unit}")
        return numbers


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


@dataclass(frozen=True)
class CsvFile:
    """The text of a CSV file, and what separates its columns."""

    path: Path
    text: str
    delimiter: str

    @classmethod
    def open(cls, path: str | Path) -> "CsvFile":
        """Read a file, gzipped or not.

        Raises
        ------
        InvalidInput
            If it cannot be read, is empty, too large, or no text.
        """
        path = Path(path)
        text = _decoded(path)
        file = cls(path, text, max(",;\t", key=text[:5000].count))
        if not file.head(1):
            raise InvalidInput(path.name, "to hold a table", "an empty file")
        return file

    def _rows(self) -> Iterator[tuple[int, list[str]]]:
        """Iterate over line numbers and cells, without blank rows and leading ``#`` comments."""
        reader = csv.reader(StringIO(self.text, newline=""), delimiter=self.delimiter)
        comments = True
        try:
            for row in reader:
                comments = comments and (not row or row[0].startswith("#"))
                if row and not comments:
                    yield reader.line_num, row
        except csv.Error as error:
            where = f"{self.path.name}, line {reader.line_num}"
            raise InvalidInput(where, "to be CSV", error) from None

    def head(self, count: int) -> list[list[str]]:
        """Return the first rows, cells without surrounding blanks."""
        return [[cell.strip() for cell in row] for _, row in islice(self._rows(), count)]

    def columns(self, names: Sequence[str], header: int = 0) -> list[Column]:
        """Return the columns called ``names`` in the row ``header``.

        Raises
        ------
        InvalidInput
            Naming the first line that is too short, or listing the columns if one is missing.
        """
        titles = self.head(header + 1)[header]
        for name in names:
            if titles.count(name) != 1:
                raise InvalidInput(f"{self.path.name}", f"to have one column {name!r}", titles)
        places = [titles.index(name) for name in names]
        last = max(places)
        cells: list[list[str]] = [[] for _ in names]
        lines: list[int] = []
        rows = islice(self._rows(), header + 1, None)
        while chunk := list(islice(rows, CHUNK)):
            for line, row in chunk:
                if len(row) <= last:
                    where = f"{self.path.name}, line {line}"
                    raise InvalidInput(where, f"to have {len(titles)} cells", len(row))
                lines.append(line)
            for column, place in zip(cells, places, strict=True):
                column.extend(row[place].strip() for _, row in chunk)
        if not lines:
            raise InvalidInput(self.path.name, "to hold rows below its header", "none")
        return [Column(name, texts, lines) for name, texts in zip(names, cells, strict=True)]


def _decoded(path: Path) -> str:
    """Return a file's text: UTF-8, or Latin-1 where a degree sign was saved so."""
    try:
        content = path.read_bytes()
        if content.startswith(b"\x1f\x8b"):
            with gzip.open(path) as file:
                content = file.read(MAX_BYTES + 1)
    except (OSError, EOFError, ZlibError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InvalidInput(str(path), "to be a readable file", reason) from None
    if len(content) > MAX_BYTES:
        raise InvalidInput(path.name, f"of at most {MAX_BYTES // 10**9} GB", "a larger file")
    if b"\0" in content:
        raise InvalidInput(path.name, "to be a text file", "a binary one")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")
