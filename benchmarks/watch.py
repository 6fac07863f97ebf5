"""Cases under watch: each runs in a process that can crash or hang without harm to the rest.

HiGHS has ended processes and compiled loops cannot be stopped from outside, so the process that
runs a case (:mod:`benchmarks.worker`) is not the one that waits for it. One that ends, or is not
done long after the case's limit, is killed with all it has started, and the case has failed.
"""

import json
import os
import select
import signal
import subprocess
import sys
from contextlib import suppress
from tempfile import TemporaryFile
from time import monotonic

from benchmarks.case import Case, Record

GRACE = 300.0
"""Time beyond twice a case's limit after which its worker is killed [s]: it may be compiling."""

LIBRARIES = "OMP", "OPENBLAS", "MKL", "NUMBA"
ONE_THREAD = {f"{library}_NUM_THREADS": "1" for library in LIBRARIES}


class Watch:
    """Runs cases one after the other in a process of its own, started anew when it is lost."""

    def __init__(self, grace: float = GRACE) -> None:
        self._grace = grace
        self._worker: _Worker | None = None

    def run(self, case: Case) -> Record:
        """Return what a case's line says beside the case itself."""
        if self._worker is None or not self._worker.alive:
            self.close()
            self._worker = _Worker()
        deadline = monotonic() + 2 * case.time_limit + self._grace
        line = self._worker.ask(json.dumps(case.record), deadline)
        if line.endswith(b"\n"):
            answer: Record = json.loads(line)
            return answer
        hung = monotonic() >= deadline
        words = self._worker.last_words()
        self.close()
        reason = "hung: killed after its limit" if hung else f"crashed: {words}"
        return {"status": "failed", "reason": reason}

    def close(self) -> None:
        """End the process and all it has started."""
        if self._worker is not None:
            self._worker.kill()
            self._worker = None


class _Worker:
    """The process, its two pipes, and a file for what is not an answer."""

    def __init__(self) -> None:
        self._said = TemporaryFile()  # noqa: SIM115  (open as long as the process)
        (child_in, self._questions), (self._answers, child_out) = os.pipe(), os.pipe()
        self._process = subprocess.Popen(
            [sys.executable, "-m", "benchmarks.worker"],
            stdin=child_in,
            stdout=child_out,
            stderr=self._said,
            env={**os.environ, **ONE_THREAD},
            start_new_session=True,
        )
        os.close(child_in)
        os.close(child_out)

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def ask(self, question: str, deadline: float) -> bytes:
        """Return the line that answers, or what came of it until the deadline or the end."""
        with suppress(BrokenPipeError):
            os.write(self._questions, question.encode() + b"\n")
        line = b""
        while not line.endswith(b"\n"):
            left = max(0.0, deadline - monotonic())
            ready, _, _ = select.select([self._answers], [], [], left)
            piece = os.read(self._answers, 1 << 16) if ready else b""
            if not piece:
                break
            line += piece
        return line

    def last_words(self) -> str:
        """Return the last line on the standard error."""
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").strip().splitlines()
        return lines[-1] if lines else "without a word"

    def kill(self) -> None:
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        os.close(self._questions)
        os.close(self._answers)
        self._said.close()
