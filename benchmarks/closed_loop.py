"""The paper's yaw tables as a closed loop: turn to what is expected, deliver in what comes.

One turbine of the paper's make, alone. Before each step the nacelle is turned to the direction that
a forecaster expects of it from what was measured until then; "true" knows it. Forecasters are
fitted to the first two thirds of the series, and the loop runs over the last third.
"""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from benchmarks.case import Record
from benchmarks.forecast import HALF_DAY, MONTH
from windopt.domain.turbine import SG_8_167
from windopt.domain.wind import WindSeries
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.conformal_persistence import ConformalPersistence
from windopt.forecasting.faults import without_faults
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.hour_ahead import HOUR, HourAhead
from windopt.forecasting.windows import Traces, chronological_split, steps_in
from windopt.planning.yaw import curve_of

Floats = NDArray[np.float64]

FORECASTERS: Mapping[str, Callable[[], Forecaster] | None] = {
    "true wind": None,
    "every step": LinearAutoregression,
    "persistence": ConformalPersistence,
    "hour ahead": lambda: HourAhead(LinearAutoregression(HALF_DAY, HOUR)),
}
"""Who says where the wind will blow from."""

DAY = 24 * HOUR

RATED = 12.5
"""Where machines of 8 MW usually reach their rated power [m/s]."""
USUALLY = 0.9
"""Share of a stretch in which the wind must be between cut-in and rated."""


def expected_directions(forecaster: Forecaster, series: WindSeries, every: int) -> Floats:
    """Return the direction expected of each row [rad], NaN where nothing is.

    Parameters
    ----------
    every
        Rows from one forecast to the next; it is held in between.
    """
    L = steps_in(forecaster.history, series.step, "history")
    expected = np.full(len(series), np.nan)
    issued = np.arange(L, len(series), every)
    rows = issued[:, None] + np.arange(-L, 0)
    known = series.valid[rows].all(axis=1)
    past = Traces(series.speed[rows[known]], series.theta_met[rows[known]])
    ahead = forecaster.forecast(past, series.step).theta_met[:, 0]
    for row, theta in zip(issued[known], ahead, strict=True):
        expected[row : row + every] = theta
    return expected


def delivered(series: WindSeries, facing: Floats) -> Floats:
    """Return the energy of each row [kWh] of a nacelle that faces ``facing`` [rad]."""
    across = np.maximum(np.cos(facing - series.theta_met), 0.0)
    power = curve_of(SG_8_167).power(series.speed * across)
    energy: Floats = power * series.step_seconds / 3.6e6
    return energy


def loop(name: str) -> Record:
    """Run the loop by one forecaster.

    Energies are of the day of the last third on which the wind, below the rated one, turned most,
    of the hour of it in which it turned most, and of the whole third.
    """
    before, after = chronological_split(without_faults(WindSeries.read(MONTH)), 1 / 3)
    make = FORECASTERS[name]
    facing = after.theta_met
    if make is not None:
        every = steps_in(HOUR, after.step, "hour") if name == "hour ahead" else 1
        facing = expected_directions(make().fit(before), after, every)
    energy, ready = delivered(after, facing), _begins(after)
    day = _most_turned(after, DAY, ready, len(after))
    hour = _most_turned(after, HOUR, day.start, day.stop)
    off = np.degrees(np.abs(np.angle(np.exp(1j * (facing - after.theta_met)))))
    return {
        "status": "scored",
        "day": str(after.time[day.start]),
        "hour": str(after.time[hour.start]),
        "hour_kwh": float(energy[hour].sum()),
        "day_kwh": float(energy[day].sum()),
        "all_kwh": float(energy[ready:].sum()),
        "hour_degrees_off": float(off[hour].mean()),
        "day_degrees_off": float(off[day].mean()),
    }


def _begins(series: WindSeries) -> int:
    """Return the first row of which every forecaster expects something."""
    return steps_in(HALF_DAY, series.step, "history")


def _most_turned(series: WindSeries, length: np.timedelta64, first: int, last: int) -> slice:
    """Return the rows of a stretch in which the wind, below the rated one, turned most in all."""
    n = steps_in(length, series.step, "length")
    turned = np.abs(np.angle(np.exp(1j * np.diff(series.theta_met, prepend=np.nan))))
    turned = np.where(np.isnan(turned), 0.0, turned)
    below = (series.speed > SG_8_167.cut_in) & (series.speed < RATED) & series.valid
    starts = range(first, last - n + 1, steps_in(HOUR, series.step, "hour"))
    usable = [start for start in starts if below[start : start + n].mean() >= USUALLY]
    best = max(usable or starts, key=lambda start: turned[start : start + n].sum())
    return slice(best, best + n)
