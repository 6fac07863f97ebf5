"""A word to whoever waits for the exact method to be compiled, which happens once."""

from windopt.cli.terminal import note

SENTENCE = (
    "Compiling the exact method, which is done once and takes about a minute; "
    "the time limit begins afterwards."
)


def tell_of_compiling(method: str) -> None:
    """Say that ``method`` is about to be compiled, where it is."""
    if method != "exact":
        return
    from windopt.solving.readiness import is_compiled  # numba loads slowly

    if not is_compiled():
        note((SENTENCE,))
