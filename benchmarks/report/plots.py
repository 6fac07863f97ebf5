"""Pictures of lines; each function draws into an Axes and returns it.

All share one signature, so that pages draw them alike: lines, what is known of their instances,
which some pictures do without, and the Axes. What each says of itself is the picture's caption.
"""

from collections.abc import Callable, Iterable, Sequence
from math import inf
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from benchmarks.case import Record
from benchmarks.report.best_known import (
    Best,
    Known,
    above,
    instance,
    measurable,
    methods,
    planned,
    proved,
)
from benchmarks.report.lines import grouped, number

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = NDArray[np.float64]

SHORTEST = 0.01
"""Wall time at which curves over time begin [s]."""
LEAST = 1e-5
"""Distance from the best bound that is drawn as none [-]."""
SHAPES = "os^Dv<>p"
"""Of the marks of each series, so that those in one place can be told apart."""
FAILED = "X"


def profile(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw the share of instances that each method has proved within a wall time."""
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        times = np.sort([record["runtime"] for record in mine if proved(record)])
        if len(times):
            shares = np.arange(1, len(times) + 1) / len(mine)
            ends = [r["time_limit"] for r in mine]
            ax.step([*times, max(ends)], [*shares, shares[-1]], where="post", label=method)
    ax.set(xscale="log", xlabel="wall time [s]", ylabel="share of instances proved [-]")
    ax.set_ylim(0, 1.02)
    _legend(ax)
    return ax


def distances(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw the share of instances on which each method's plan is so close to the best bound."""
    for method in methods(records):
        mine = [record for record in records if record["method"] == method]
        found = planned(mine)
        gaps = np.sort([max(LEAST, above(record, known[instance(record)])) for record in found])
        shares = np.arange(1, len(gaps) + 1) / max(1, len(mine))
        if np.isfinite(gaps).any():
            ax.step(100 * gaps, shares, where="post", label=method)
    ax.set(xscale="log", xlabel="plan above the best bound [%]", ylabel="share of instances [-]")
    ax.set_ylim(0, 1.02)
    _legend(ax)
    return ax


def gap_over_time(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw how far the best plan so far is above the best bound known, mean over the instances.

    A curve begins when its method has a plan for every instance; one that never has, has none.
    """
    _over_time(records, known, ax, _plans_above)
    ax.set_ylabel("best plan so far above the best bound, mean [%]")
    return ax


def bound_over_time(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw how far the bound so far is below the best plan known, mean over the instances.

    A curve begins when its method has a bound for every instance; one that never has, has none.
    """
    _over_time(records, known, ax, _bounds_below)
    ax.set_ylabel("bound so far below the best plan, mean [%]")
    return ax


def _over_time(
    records: Sequence[Record],
    known: Known,
    ax: "Axes",
    off: Callable[[Record, Best, Floats], Floats],
) -> None:
    ends = (max(r["time_limit"], r.get("runtime", 0.0)) for r in records)  # a little late, maybe
    times = np.geomspace(SHORTEST, max(ends, default=1.0), 200)
    lines = measurable(records, known)
    for method in methods(lines):
        mine = [record for record in lines if record["method"] == method]
        gaps = np.mean([off(record, known[instance(record)], times) for record in mine], 0)
        if (begun := np.isfinite(gaps)).any():
            shares = 100 * np.maximum(gaps[begun], LEAST)
            ax.plot(times[begun], shares, marker=".", markevery=[0], label=method)
    ax.set(xscale="log", yscale="log", xlabel="wall time [s]")
    _legend(ax)


def _plans_above(record: Record, best: Best, times: Floats) -> Floats:
    moments = [(0.0, inf), *((time, number(value, inf)) for time, value, _ in _trace(record))]
    began, objectives = np.array(sorted(moments)).T
    gaps: Floats = np.maximum(_at(times, began, np.minimum.accumulate(objectives)) - best.bound, 0)
    return gaps / best.bound


def _bounds_below(record: Record, best: Best, times: Floats) -> Floats:
    moments = [(0.0, -inf), *((time, number(value, -inf)) for time, _, value in _trace(record))]
    began, bounds = np.array(sorted(moments)).T
    gaps: Floats = np.maximum(best.objective - _at(times, began, np.maximum.accumulate(bounds)), 0)
    return gaps / best.objective


def _trace(record: Record) -> Sequence[tuple[float, float | None, float | None]]:
    """Return times, plans and bounds until the end; a failed case has none."""
    if record["status"] == "failed":
        return []
    return [*record["trace"], (record["runtime"], record["objective"], record["bound"])]


def _at(times: Floats, began: Floats, values: Floats) -> Floats:
    """Return the value that holds at each time."""
    held: Floats = values[np.searchsorted(began, times, side="right") - 1]
    return held


def _legend(ax: "Axes") -> None:
    """Write what is drawn beside the picture, where it hides no curve."""
    if ax.has_data():
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)


def growth(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw the wall time to proof over the number of turbines.

    Open marks are where a method ended without a proof, crosses where it failed.
    """
    _sizes(grouped(records, lambda record: str(record["method"])).items(), ax)
    return ax


def growth_by_dwell(records: Sequence[Record], known: Known, ax: "Axes") -> "Axes":
    """Draw the wall time to proof over the number of turbines.

    Open marks are where the method ended without a proof, crosses where it failed.
    """
    _sizes(grouped(records, lambda record: f"{record['dwell']:g} s at each turbine").items(), ax)
    return ax


def _sizes(series: Iterable[tuple[str, Sequence[Record]]], ax: "Axes") -> None:
    for i, (label, lines) in enumerate(series):
        mine = [record for record in lines if record.get("turbines")]
        shape = SHAPES[i % len(SHAPES)]
        ax.scatter([], [], s=18, c=f"C{i}", marker=shape, label=label)
        fates = grouped(mine, lambda record: (proved(record), record["status"] == "failed"))
        for (done, failed), fate in fates.items():
            n = [float(record["turbines"]) for record in fate]
            seconds = [float(record.get("runtime") or record["time_limit"]) for record in fate]
            face, mark = f"C{i}" if done else "none", FAILED if failed else shape
            ax.scatter(n, seconds, s=18, c=face, edgecolors=f"C{i}", marker=mark)
    ax.set(yscale="log", xlabel="turbines", ylabel="wall time [s]")
    _legend(ax)
