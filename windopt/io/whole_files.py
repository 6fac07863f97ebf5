"""Files that are written whole or not at all."""

import os
from pathlib import Path
from secrets import token_hex

from windopt.errors import InvalidInput


def require_absent(path: str | Path, *, force: bool = False) -> None:
    """Raise if there is a folder at ``path``, or a file and ``force`` is not set."""
    if Path(path).is_dir():
        raise InvalidInput("output", "to be a file", f"the folder {path}")
    if Path(path).exists() and not force:
        raise InvalidInput("output", "to be a new file unless --force is given", path)


def write_whole(path: str | Path, content: str | bytes, *, force: bool = False) -> Path:
    """Write a file so that no reader ever sees half of it.

    The content goes to a temporary file beside ``path``, reaches the disk and is then renamed,
    which the file system does in one step. Missing folders are made.

    Parameters
    ----------
    path
        Where to write.
    content
        Text, written as UTF-8, or bytes.
    force
        Whether a file that is already there may be replaced.

    Raises
    ------
    InvalidInput
        If ``path`` is taken and ``force`` is not set, or is a folder.
    OSError
        If the disk refuses; the file is then as it was before.
    """
    path = Path(path)
    require_absent(path, force=force)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{token_hex(4)}.part")
    try:
        with part.open("xb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
    return path
