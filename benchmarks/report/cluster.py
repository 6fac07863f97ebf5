"""From one farm to all of them: the machines that measured times ask for."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from math import ceil
from pathlib import Path
from statistics import median

from benchmarks.case import Record
from benchmarks.report import rst
from benchmarks.report.routing_tables import answered

EVERY = 300.0
"""How often every farm is planned anew [s]."""


def cluster_page(records: Sequence[Record], out: Path) -> Iterator[str]:
    """Yield the page on the cluster that plans every farm every five minutes."""
    real = [
        record
        for record in answered(records)
        if record["problem"] == "routing" and not record["instance"].startswith("grid")
    ]
    if not real:
        return
    yield rst.title("From one farm to all of them")
    yield TEXT
    yield rst.table("Processors for every farm measured, every five minutes", needed(real))
    yield AFTER


def needed(records: Sequence[Record]) -> list[list[str]]:
    """Return a row for each method and limit: its farms, their times and the processors needed.

    A farm counts with the mean over its instances. The times of all farms, one after the other,
    over the five minutes give the processors; a farm that takes longer than that alone is late
    however many there are.
    """
    times: dict[tuple[str, float], dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    for record in records:
        times[record["method"], record["time_limit"]][record["farm"]].append(record["cpu"])
    rows = [
        ["method", "limit s", "farms", "median s", "longest s", "sum s", "processors", "late farms"]
    ]
    for (method, limit), farms in times.items():
        means = [sum(values) / len(values) for values in farms.values()]
        late = sum(mean > EVERY for mean in means)
        rows.append(
            [method, f"{limit:g}", str(len(means)), f"{median(means):.2f}", f"{max(means):.1f}",
             f"{sum(means):.0f}", str(max(1, ceil(sum(means) / EVERY))), str(late)]
        )  # fmt: skip
    return rows


TEXT = """\
Farms do not depend on each other, so the whole library is planned by as many processes as there are
farms, and the work is the sum of their times. The times are processor seconds of one plan, the mean
over the winds and dwells of each farm; starting processes and reading wind are not in them, nor are
yaw set-points and forecasts.
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
