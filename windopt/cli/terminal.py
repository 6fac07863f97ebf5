"""What a person sees: sentences, complaints, and progress on a terminal only."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from logging import INFO, Handler, Logger, LogRecord
from math import isfinite

from rich.console import Console
from rich.markup import escape
from rich.progress import Progress as Clock
from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

Told = Callable[[float, float], str]

CLOSED, HARDLY = 1e-9, 5e-5
"""Between these a gap is open, and would be printed as 0.00 %."""

out = Console(highlight=False, soft_wrap=True, emoji=False)
err = Console(stderr=True, highlight=False, soft_wrap=True, emoji=False)


def say(sentence: str) -> None:
    """Print a sentence."""
    out.print(escape(sentence))


def complain(sentence: str) -> None:
    """Print a sentence where complaints go."""
    err.print(escape(sentence), style="red")


def note(sentences: tuple[str, ...]) -> None:
    """Print what a reader assumed or found, where complaints go."""
    for sentence in sentences:
        err.print(escape(sentence), style="dim")


def counted(number: int, thing: str) -> str:
    """Return a number of things in words: 1 flight, 2 flights."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


def percent(gap: float) -> str:
    """Return a gap in percent; one that is open is never told as none."""
    return "<0.01%" if CLOSED < gap < HARDLY else f"{max(0.0, gap):.2%}"


def seconds(objective: float, bound: float) -> str:
    """Say what a plan takes and what every plan takes at least [s]."""
    return f"plan {objective:.1f} s, bound {bound:.1f} s"


def left_out(what: str, unit: float) -> Told:
    """Return what says how much is left out, and must be; one of it is worth ``unit`` [s]."""
    return lambda objective, bound: (
        f"{what} left out: {objective // unit:.0f}, at least {bound // unit:.0f}"
    )


class _Notes(Handler):
    """Prints what is logged as notes."""

    def emit(self, record: LogRecord) -> None:
        note((record.getMessage(),))


@contextmanager
def overheard(logger: Logger) -> Iterator[None]:
    """Print what a part of the library logs meanwhile."""
    notes, level = _Notes(), logger.level
    logger.addHandler(notes)
    logger.setLevel(INFO)
    try:
        yield
    finally:
        logger.setLevel(level)
        logger.removeHandler(notes)


@contextmanager
def progress(task: str, told: Told = seconds) -> Iterator[Callable[[float, float], None]]:
    """Show a task with its objective and bound while it runs; silent off a terminal.

    Parameters
    ----------
    told
        Says what objective and bound mean.
    """
    if not err.is_terminal:
        yield lambda objective, bound: None
        return
    with _clock(task) as show:

        def update(objective: float, bound: float) -> None:
            if isfinite(objective):
                gap = (objective - bound) / objective if objective else 0.0
                show(f"{task}: gap {percent(gap)}, {told(objective, bound)}")

        yield update


@contextmanager
def counter(task: str) -> Iterator[Callable[[int, int], None]]:
    """Show how much of a task is done while it runs; silent off a terminal."""
    if not err.is_terminal:
        yield lambda done, of: None
        return
    with _clock(task) as show:
        yield lambda done, of: show(f"{task}: {done} of {of}")


@contextmanager
def _clock(task: str) -> Iterator[Callable[[str], None]]:
    """Show a line behind a clock that runs, and yield what changes the line."""
    line = TextColumn("{task.description}", markup=False)
    columns = SpinnerColumn(), TimeElapsedColumn(), line  # a narrow terminal cuts the end off
    with Clock(*columns, console=err, transient=True) as clock:
        only = clock.add_task(task)
        yield lambda text: clock.update(only, description=text)
