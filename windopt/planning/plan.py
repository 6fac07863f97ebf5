"""The main job: a measured series in; a forecast, yaw set-points and flights out."""

from collections.abc import Callable, Sequence
from time import perf_counter

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.plan import Plan, SpeedRule
from windopt.domain.power_curve import STANDARD_AIR_DENSITY
from windopt.domain.steering import Pace, Steering
from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput, require_kind, require_one_of
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.persistence import Persistence
from windopt.planning.assignment import Assignment
from windopt.planning.inspection import DEFAULT_METHOD, plan_inspection
from windopt.planning.reach import dwell_per_turbine
from windopt.planning.routing_methods import chosen_method, make_ready
from windopt.planning.schedule import METHOD as DEFAULT_YAW_METHOD
from windopt.planning.schedule import plan_schedule, stopped
from windopt.planning.search_options import MEMORY, SearchOptions
from windopt.planning.start import Start, inspection_of
from windopt.planning.worth import worth_per_turbine
from windopt.trace import Progress

FORECASTERS: dict[str, Callable[[], Forecaster]] = {
    "lstm": EdgeForecaster,
    "autoregression": LinearAutoregression,
    "persistence": Persistence,
}
"""Forecasters by the name they are chosen by."""

DEFAULT_FORECASTER = "lstm"

MODEL = ".npz"
"""How the file of a trained model ends."""

YAW_SHARE = 0.5
"""Share of the time limit that the set-points may use; flights have all that is left of it."""


def plan(
    farm: Farm,
    fleet: Fleet,
    series: WindSeries,
    *,
    time: np.datetime64 | None = None,
    forecaster: Forecaster | str = DEFAULT_FORECASTER,
    yaw_method: str = DEFAULT_YAW_METHOD,
    steering: Steering | None = None,
    pace: Pace | None = None,
    air_density: float = STANDARD_AIR_DENSITY,
    method: str = DEFAULT_METHOD,
    dwell: float | Sequence[float] = 0.0,
    rule: SpeedRule | str = SpeedRule.EXACT,
    worth: float | Sequence[float] | None = None,
    assignment: Assignment | None = None,
    start: Start | None = None,
    gap: float = 0.0,
    time_limit: float = 60.0,
    memory: float = MEMORY,
    seed: int = 0,
    progress: Progress | None = None,
) -> Plan:
    """Forecast the wind, set the turbines' yaw for each step ahead and plan the flights.

    Parameters
    ----------
    series
        Measured wind; what lies after ``time`` is not looked at.
    time
        When the plan is made, on the series' own clock; its last row unless given.
    forecaster
        One of :data:`FORECASTERS`, fitted to the series up to ``time``; or the file of a trained
        model; or a forecaster of your own, taken as it is. The LSTM that comes with windopt is
        for series of 5 and 10 minutes.
    yaw_method, method
        Methods for set-points and for flights.
    steering, pace, air_density
        As in :func:`windopt.planning.schedule.plan_schedule`, for the set-points.
    dwell, rule, worth, assignment, start, gap, memory, progress
        As in :func:`windopt.plan_inspection`, for the flights.
    time_limit
        Wall-clock limit of the whole plan [s], which begins once the method ``exact`` is compiled.
        Ctrl-C ends it early: what is left to do is then done in the quickest way.
    seed
        Of whatever is drawn at random.

    Returns
    -------
    Plan
        Set-points for each step, the nacelles starting in the wind last measured, and flights
        for the mean wind of the forecast.

    Raises
    ------
    InvalidInput
        If the farm, the fleet or the series is not one, ``time`` lies outside the series, the
        series is too short or too full of gaps for the forecaster, a name is unknown, or an option
        cannot be used.
    FailedCheck
        If the independent checker finds a fault in the set-points or the flights.
    """
    require_kind("farm", farm, Farm)
    require_kind("fleet", fleet, Fleet)
    require_kind("series", series, WindSeries)
    # Most of what cannot be flown is refused here, before set-points take half of the time.
    SearchOptions(gap, time_limit, seed, memory)
    require_one_of("rule", rule, SpeedRule)
    dwells, worths = dwell_per_turbine(farm, dwell), worth_per_turbine(farm, fleet, worth)
    chosen_method(method, weighs=worths is not None, improves=start is not None)
    start = None if start is None else inspection_of(start)
    make_ready(method)
    begin = perf_counter()
    pace = pace or Pace()
    known = series if time is None else series.until(time)
    forecast = _fitted(forecaster, known).predict(known)
    yaw = plan_schedule(
        farm,
        forecast,
        nacelle=_last_direction(known),
        method=yaw_method,
        steering=steering,
        pace=pace,
        air_density=air_density,
        time_limit=YAW_SHARE * time_limit,
        seed=seed,
    )
    left = 0.0 if stopped(yaw) else max(0.0, begin + time_limit - perf_counter())
    inspection = plan_inspection(
        farm,
        fleet,
        forecast.mean,
        method=method,
        dwell=dwells,
        rule=rule,
        worth=worths,
        assignment=assignment,
        start=start,
        gap=gap,
        time_limit=left,
        memory=memory,
        seed=seed,
        progress=progress,
    )
    return Plan(forecast.issued, forecast, yaw, inspection, pace)


def require_forecaster(field: str, name: str) -> None:
    """Raise unless ``name`` is that of a forecaster or of a model's file."""
    if name not in FORECASTERS and not name.endswith(MODEL):
        expected = f"to be one of {', '.join(FORECASTERS)}, or a model's {MODEL} file"
        raise InvalidInput(field, expected, repr(name))


def _fitted(forecaster: Forecaster | str, known: WindSeries) -> Forecaster:
    if not isinstance(forecaster, str):
        return forecaster
    require_forecaster("forecaster", forecaster)
    if forecaster.endswith(MODEL):
        return EdgeForecaster.load(forecaster)
    return FORECASTERS[forecaster]().fit(known)


def _last_direction(known: WindSeries) -> float:
    """Return the wind direction last measured [rad, met.]."""
    return float(known.theta_met[known.valid][-1])
