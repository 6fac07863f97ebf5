"""A word to whoever waits for the exact method to be compiled, which happens once."""

from windopt.cli.terminal import err, note

SENTENCE = (
    "Compiling the exact method, which is done once and takes about half a minute; "
    "the time limit begins afterwards."
)


def tell_of_compiling(method: str) -> None:
    """Say on a terminal that ``method`` is about to be compiled, where it is."""
    if method != "exact" or not err.is_terminal:
        return
    from windopt.solving.readiness import is_compiled  # numba loads slowly

    if not is_compiled():
        note((SENTENCE,))
