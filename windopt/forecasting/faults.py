"""Faults of sensors: what a mast reports although it did not measure it.

Three are common enough to be looked for. A vane that is stuck, or frozen, reports one direction for
hours while the wind blows; a logger that lost its sensors repeats the last row; and a spike is a
speed that comes from nowhere and is gone in the next row. What is found is masked, not mended, and
each series says in its notes what was masked.

Speeds below ``CALM`` are no evidence: a vane rightly rests in them. Nor is an hour or two where
directions are reported in coarse steps, as airports do.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windopt.domain.wind import Floats, WindSeries
from windopt.forecasting.windows import minutes

CALM = 1.0  # m/s; common starting threshold of cups and vanes, with a margin
STUCK = np.timedelta64(2, "h")
STUCK_IF_COARSE = np.timedelta64(24, "h")
COARSE = 72  # or fewer directions that recur: steps of 5 degrees or more
REPEATED = np.timedelta64(30, "m")
SPEED_LIMIT = 75.0  # m/s; the strongest means on record at wind farm masts stay below
SPIKE = 12.0  # m/s above both neighbours, and
SPIKE_RATIO = 3.0  # times both neighbours

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Faults:
    """Rows that no sensor measured, each of shape ``(T,)``.

    Parameters
    ----------
    stuck
        The direction rests for ``STUCK`` or longer while the wind blows, or for
        ``STUCK_IF_COARSE`` where directions come in coarse steps.
    repeated
        Speed and direction both rest for ``REPEATED`` or longer.
    spikes
        The speed leaps up for one row, or is beyond ``SPEED_LIMIT``.
    """

    stuck: Mask
    repeated: Mask
    spikes: Mask

    @property
    def any(self) -> Mask:
        """Rows with a fault of some kind."""
        return self.stuck | self.repeated | self.spikes

    @property
    def kinds(self) -> tuple[tuple[str, Mask], ...]:
        """Each kind of fault that was found, and its rows."""
        found = (
            ("a direction that rests for hours in wind", self.stuck),
            (f"speed and direction that rest for {minutes(REPEATED)} or longer", self.repeated),
            ("a spike of speed", self.spikes),
        )
        return tuple((kind, mask) for kind, mask in found if mask.any())


def find_faults(series: WindSeries) -> Faults:
    """Look for stuck vanes, repeated rows and spikes."""
    blowing = np.nan_to_num(series.speed) > CALM
    rests = _same_as_before(series.theta_met)
    both = rests & _same_as_before(series.speed)
    limit = STUCK_IF_COARSE if _coarse(series.theta_met[series.valid]) else STUCK
    stuck = _runs(rests, _rows(limit, series)) & blowing
    repeated = _runs(both, _rows(REPEATED, series)) & blowing
    return Faults(stuck, repeated & ~stuck, _spikes(series.speed))


def without_faults(series: WindSeries) -> WindSeries:
    """Return ``series`` with faulty rows missing, and notes that say which."""
    faults = find_faults(series)
    if not faults.any.any():
        return series
    return replace(
        series,
        speed=np.where(faults.any, np.nan, series.speed),
        theta_met=np.where(faults.any, np.nan, series.theta_met),
        notes=(
            *series.notes,
            *(f"{mask.sum()} rows masked: {kind}." for kind, mask in faults.kinds),
        ),
    )


def suspected(series: WindSeries, rows: int) -> tuple[str, ...]:
    """Return a warning for each kind of fault in the last ``rows`` rows of ``series``."""
    counts = ((kind, mask[-rows:].sum()) for kind, mask in find_faults(series).kinds)
    return tuple(f"{n} of the last {rows} rows look faulty: {kind}." for kind, n in counts if n)


def _coarse(theta_met: Floats) -> bool:
    """Whether directions come in few steps, to which they return again and again."""
    directions, changes = len(np.unique(theta_met)), np.count_nonzero(np.diff(theta_met))
    return 1 < directions <= min(COARSE, changes / 2)


def _rows(duration: np.timedelta64, series: WindSeries) -> int:
    """Rows in ``duration``, at least three: two equal rows are no evidence."""
    return max(3, int(duration / series.step))


def _same_as_before(values: Floats) -> Mask:
    """Whether a row equals the one before it."""
    return np.concatenate([[False], values[1:] == values[:-1]])


def _runs(same: Mask, rows: int) -> Mask:
    """Rows in runs of at least ``rows`` equal values, the first of each run included."""
    run = np.cumsum(~same) - 1  # each row's run, counted from 0
    in_long_run: Mask = (np.bincount(run) >= rows)[run]
    return in_long_run


def _spikes(speed: Floats) -> Mask:
    """Rows far above both neighbours, or beyond what blows on this planet."""
    known = np.nan_to_num(speed)
    before, after = np.roll(known, 1), np.roll(known, -1)
    before[0], after[-1] = after[0], before[-1]
    around = np.maximum(before, after)
    return (known > SPEED_LIMIT) | ((known > around + SPIKE) & (known > SPIKE_RATIO * around))
