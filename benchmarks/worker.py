"""The process that runs cases: one on each line of the standard input, an answer on each line out.

It is started and watched by :mod:`benchmarks.watch`, has processors to itself where they are
free, and ends at once when its input does, whatever it is at. What a solver prints goes to the
standard error, so that it cannot be taken for an answer. A method runs once on something tiny
before it is measured.
"""

import json
import os
import sys
from contextlib import suppress
from queue import SimpleQueue
from threading import Thread
from typing import TextIO

from benchmarks.case import Case, Record
from benchmarks.processor import EACH, claim_processors
from benchmarks.registry import problem


def answer(case: Case) -> Record:
    """Measure a case; an exception becomes a record."""
    try:
        return problem(case.problem).measure(case)
    except Exception as failure:  # the line says so, and the next case goes on
        return {"status": "failed", "reason": f"{type(failure).__name__}: {failure}"}


def serve(lines: "SimpleQueue[str]", answers: TextIO) -> None:
    """Answer each line."""
    warm: set[tuple[str, str]] = set()
    while True:
        case = Case(**json.loads(lines.get()))
        kind = case.problem, case.method
        if kind not in warm:
            warm.add(kind)
            with suppress(Exception):  # the case will tell
                problem(case.problem).warm_up(case.method)
        answers.write(json.dumps(answer(case)) + "\n")
        answers.flush()


def listen(lines: "SimpleQueue[str]") -> None:
    """Queue what comes in, and end the process when nothing more can come."""
    for line in sys.stdin:
        lines.put(line)
    os._exit(0)


def main() -> None:
    """Serve the standard input."""
    claim_processors(int(os.environ.get(EACH, 1)))
    lines: SimpleQueue[str] = SimpleQueue()
    with os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8") as answers:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
        Thread(target=listen, args=(lines,), daemon=True).start()
        serve(lines, answers)


if __name__ == "__main__":
    main()
