"""Whether the compiled loops are on disk, or a first search will compile them."""

from pathlib import Path

from windopt.solving.exact.labelling import labels


def is_compiled() -> bool:
    """Tell whether an earlier search has left its compiled loops on disk."""
    folder = Path(labels.stats.cache_path)  # type: ignore[attr-defined]
    return any(folder.glob("labelling.labels-*.nbi"))
