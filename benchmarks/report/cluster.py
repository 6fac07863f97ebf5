"""From one farm to all of them: the machines that measured times ask for."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from statistics import mean, median

from benchmarks.case import Record
from benchmarks.report import rst
from benchmarks.report.best_known import LP, handle, planned, proved
from benchmarks.report.lines import Rows, answered, grouped
from benchmarks.report.routing_pages import real_farms
from windopt.io.optiwindnet import optiwindnet_sizes

EVERY = 300.0
"""How often every farm is planned anew [s]."""


def cluster_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page on the cluster that plans every farm every five minutes."""
    real = [r for r in real_farms(records) if not r["method"].endswith(LP)]
    if not real:
        return
    yield rst.title("From one farm to all of them")
    yield TEXT.format(library=len(optiwindnet_sizes()))
    yield rst.table("Processors that plan every farm measured, every five minutes", needed(real))
    yield AFTER


def needed(records: Sequence[Record]) -> Rows:
    """Return a row for each method and limit, those of most farms first.

    A farm counts with the mean over its instances, a case that failed with its time limit.
    """
    rows = [
        ["method", "limit s", "farms", "plans", "proved", "failed", "CPU s a farm: median",
         "longest", "sum", "processors", "late farms"]
    ]  # fmt: skip
    kinds = grouped(records, lambda record: (record["method"], record["time_limit"]))
    for (method, limit), mine in kinds.items():
        farms = grouped(mine, handle).values()
        times = [mean(map(_spent, cases)) for cases in farms]
        rows.append(
            [method, f"{limit:g}", str(len(times)), str(len(planned(mine))),
             str(sum(map(proved, mine))), str(len(mine) - len(answered(mine))),
             f"{median(times):.2f}", f"{max(times):.1f}", f"{sum(times):.0f}",
             str(processors(times)), str(sum(time > EVERY for time in times))]
        )  # fmt: skip
    return rows[:1] + sorted(rows[1:], key=lambda row: -int(row[2]))


def _spent(record: Record) -> float:
    """Return the processor time of a case [s], its limit where it failed."""
    return float(record["time_limit"] if record["status"] == "failed" else record["cpu"])


def processors(times: Iterable[float]) -> int:
    """Return how many processors plan farms of these times [s] every five minutes.

    Each farm, the longest first, goes to the first processor that has time for it; one that takes
    longer than that has a processor of its own, and is late all the same.
    """
    busy: list[float] = []
    for time in sorted(times, reverse=True):
        free = next((i for i, taken in enumerate(busy) if taken + time <= EVERY), len(busy))
        if free == len(busy):
            busy.append(0.0)
        busy[free] += time
    return len(busy)


TEXT = """\
OptiWindNet has {library} farms whose coordinates are known. They do not depend on each other, so
all of them are planned by as many processes as there are, and a farm is not split among
processors. The times are processor seconds of a case, the mean over the winds and dwells of each
farm, and a case that failed counts with its limit; starting processes and reading wind are not in
them, nor are yaw set-points and forecasts.
Small farms were measured in more winds and by more methods than all farms were, so compare rows
of as many farms.
"""

AFTER = """\
The same run goes to a cluster by the address of its scheduler:

.. code-block:: console

   $ dask scheduler
   $ dask worker tcp://scheduler:8786 --nthreads 1
   $ python -m benchmarks run routing --set medium --scheduler tcp://scheduler:8786

Nothing but names and numbers travels, so the network does not matter, and a worker needs the
packages and a copy of the repository.
"""
