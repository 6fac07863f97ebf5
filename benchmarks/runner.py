"""Runs cases side by side and writes a line for each as it comes.

The same call runs on the processors of this machine (joblib's loky) or on a dask cluster.
"""

import atexit
import os
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from joblib import Parallel, delayed, parallel_config
from joblib.externals.loky.process_executor import TerminatedWorkerError
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from benchmarks.case import Case, Record
from benchmarks.records import appended, machine, origin, read_lines
from benchmarks.watch import Watch
from windopt.errors import MissingExtra


def run(
    cases: Sequence[Case], lines: Path, *, jobs: int = 1, scheduler: str = "", command: str = ""
) -> list[Record]:
    """Run the cases that have no line yet, and return the lines of all.

    Parameters
    ----------
    lines
        The file of JSON lines, which is added to.
    jobs
        Cases at a time on this machine.
    scheduler
        Address of a dask scheduler, whose workers run the cases instead.
    command
        What the lines say they were made by.
    """
    done = {key(record) for record in read_lines(lines)}
    left = [case for case in cases if case.key not in done]
    about = origin(command)
    columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn()
    console = Console(stderr=True)
    with Progress(
        *columns, TimeElapsedColumn(), console=console, disable=not console.is_terminal
    ) as bar:
        task = bar.add_task("", total=len(left))
        for case, answer in answers(left, jobs, scheduler):
            appended(case.record | answer | about, lines)
            bar.update(task, advance=1, description=f"{case}: {answer['status']}")
    wanted = {case.key for case in cases}
    return [record for record in read_lines(lines) if key(record) in wanted]


def key(record: Record) -> tuple[Any, ...]:
    """Return the key of the case that a line is about."""
    return tuple(record[name] for name in ("problem", "instance", "method", "time_limit", "seed"))


def answers(cases: Sequence[Case], jobs: int, scheduler: str = "") -> Iterator[tuple[Case, Record]]:
    """Yield cases with what their lines say, in the order in which they are done.

    Should a process be lost that waits for others, its cases are run again.
    """
    left = {case.key: case for case in cases}
    while left:
        before = len(left)
        try:
            for case, answer in _side_by_side(list(left.values()), jobs, scheduler):
                del left[case.key]
                yield case, answer
        except TerminatedWorkerError:
            if len(left) == before:
                raise


def _side_by_side(
    cases: Sequence[Case], jobs: int, scheduler: str
) -> Iterable[tuple[Case, Record]]:
    with _backend(scheduler):
        parallel = Parallel(n_jobs=jobs, batch_size=1, return_as="generator_unordered")
        home = 0 if scheduler else os.getpid()
        yield from parallel(delayed(_watched)(case, home) for case in cases)


def _backend(scheduler: str) -> AbstractContextManager[Any]:
    if not scheduler:
        local: AbstractContextManager[Any] = parallel_config(backend="loky")
        return local
    try:
        from distributed import Client
    except ModuleNotFoundError:
        raise MissingExtra("A run on a cluster", "cluster") from None
    cluster: AbstractContextManager[Any] = parallel_config(backend="dask", client=Client(scheduler))
    return cluster


_this = threading.local()


def _watched(case: Case, home: int) -> tuple[Case, Record]:
    """Run a case under the one watch of this thread; a dask worker may have several.

    Parameters
    ----------
    home
        The process without which this one has nothing to do, or 0.
    """
    if not hasattr(_this, "watch"):
        _this.watch = Watch()
        atexit.register(_this.watch.close)
        if home not in {0, os.getpid()}:
            threading.Thread(target=_end_with, args=(home, _this.watch), daemon=True).start()
    return case, _this.watch.run(case) | {"machine": machine()}


def _end_with(home: int, watch: Watch) -> None:
    """End this process soon after the one that started it, which may have been killed."""
    while os.getppid() == home:
        time.sleep(1.0)
    watch.close()
    os._exit(1)
