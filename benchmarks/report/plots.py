"""Pictures of lines; each function draws into an Axes and returns it."""

from collections.abc import Sequence
from math import inf
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from benchmarks.case import Record
from benchmarks.report.routing_tables import (
    Best,
    above,
    answered,
    best_known,
    instance,
    methods,
    number,
    proved,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHORTEST = 0.01
"""Time at which curves over time begin [s]."""
LEAST = 1e-5
"""Distance from the best bound that is drawn as none [-]."""


def profile(records: Sequence[Record], ax: "Axes") -> "Axes":
    """Draw the share of instances that each method has proved within a time."""
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        times = np.sort([record["runtime"] for record in mine if proved(record)])
        if len(times):
            shares = np.arange(1, len(times) + 1) / len(mine)
            ends = [r["time_limit"] for r in mine]
            ax.step([*times, max(ends)], [*shares, shares[-1]], where="post", label=method)
    ax.set(xscale="log", xlabel="time [s]", ylabel="share of instances proved [-]", ylim=(0, 1.02))
    ax.legend()
    return ax


def distances(records: Sequence[Record], ax: "Axes") -> "Axes":
    """Draw the share of instances on which each method's plan is so close to the best bound."""
    known = best_known(records)
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        found = [record for record in answered(mine) if record["objective"] is not None]
        gaps = np.sort([max(LEAST, above(record, known[instance(record)])) for record in found])
        shares = np.arange(1, len(gaps) + 1) / max(1, len(mine))
        ax.step(100 * gaps, shares, where="post", label=method)
    ax.set(xscale="log", xlabel="plan above the best bound [%]", ylabel="share of instances [-]")
    ax.set_ylim(0, 1.02)
    ax.legend()
    return ax


def gap_over_time(records: Sequence[Record], ax: "Axes") -> "Axes":
    """Draw how far the best plan so far is above the best bound known, mean over the instances.

    A curve begins when its method has a plan for every instance.
    """
    known = best_known(records)
    latest = max((record["time_limit"] for record in records), default=1.0)
    times = np.geomspace(SHORTEST, latest, 200)
    for method in methods(records):
        mine = [r for r in answered(records) if r["method"] == method and r["objective"]]
        if mine:
            gaps = np.mean([_gaps(record, known[instance(record)], times) for record in mine], 0)
            ax.plot(times, 100 * np.maximum(gaps, LEAST), label=method)
    ax.set(xscale="log", yscale="log", xlabel="time [s]")
    ax.set_ylabel("best plan so far above the best bound, mean [%]")
    ax.legend()
    return ax


def _gaps(record: Record, best: Best, times: NDArray[np.float64]) -> NDArray[np.float64]:
    moments = [(0.0, inf), *((time, number(value, inf)) for time, value, _ in record["trace"])]
    moments.append((record["runtime"], record["objective"]))
    began, objectives = np.array(sorted(moments)).T
    so_far = np.minimum.accumulate(objectives)[np.searchsorted(began, times, side="right") - 1]
    gaps: NDArray[np.float64] = np.maximum(so_far - best.bound, 0.0) / best.bound
    return gaps


def growth(records: Sequence[Record], ax: "Axes") -> "Axes":
    """Draw the time of each answer over the number of turbines; open circles are not proved."""
    for number_, method in enumerate(methods(records)):
        mine = [record for record in answered(records) if record["method"] == method]
        for done in True, False:
            points = [(r["turbines"], r["runtime"]) for r in mine if proved(r) is done]
            if points:
                colour = f"C{number_}"
                face = colour if done else "none"
                label = method if done or not any(map(proved, mine)) else None
                n, seconds = zip(*points, strict=True)
                ax.scatter(n, seconds, s=18, c=face, edgecolors=colour, label=label)
    ax.set(xscale="log", yscale="log", xlabel="turbines", ylabel="time [s]")
    ax.legend()
    return ax
