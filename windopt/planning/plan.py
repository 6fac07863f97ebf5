"""The main job: a measured series in; a forecast, yaw set-points and flights out."""

from collections.abc import Callable, Sequence

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet
from windopt.domain.plan import Plan, SpeedRule, YawPlan
from windopt.domain.wind import WindForecast, WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.autoregression import LinearAutoregression
from windopt.forecasting.forecaster import Forecaster
from windopt.forecasting.lstm import EdgeForecaster
from windopt.forecasting.persistence import Persistence
from windopt.planning.inspection import DEFAULT_METHOD, plan_inspection
from windopt.planning.routing_methods import Progress
from windopt.planning.yaw import plan_yaw
from windopt.result import Result

FORECASTERS: dict[str, Callable[[], Forecaster]] = {
    "lstm": EdgeForecaster,
    "autoregression": LinearAutoregression,
    "persistence": Persistence,
}
"""Forecasters by the name they are chosen by."""

DEFAULT_FORECASTER = "lstm"


def plan(
    farm: Farm,
    fleet: Fleet,
    series: WindSeries,
    *,
    time: np.datetime64 | None = None,
    forecaster: Forecaster | str = DEFAULT_FORECASTER,
    yaw_method: str = "nlp",
    method: str = DEFAULT_METHOD,
    dwell: float | Sequence[float] = 0.0,
    rule: SpeedRule | str = SpeedRule.EXACT,
    gap: float = 0.0,
    time_limit: float = 60.0,
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
    dwell, rule, gap, time_limit, seed, progress
        As in :func:`windopt.plan_inspection`, for the flights.

    Returns
    -------
    Plan
        Set-points for each step, the nacelles starting in the wind last measured, and flights
        for the mean wind of the forecast.

    Raises
    ------
    InvalidInput
        If ``time`` lies outside the series, the series is too short or too full of gaps for the
        forecaster, or a name is unknown.
    """
    known = series if time is None else series.until(time)
    forecast = _fitted(forecaster, known).predict(known)
    yaw = _yaw_steps(farm, forecast, start=_last_direction(known), method=yaw_method, seed=seed)
    inspection = plan_inspection(
        farm,
        fleet,
        forecast.mean,
        method=method,
        dwell=dwell,
        rule=rule,
        gap=gap,
        time_limit=time_limit,
        seed=seed,
        progress=progress,
    )
    return Plan(forecast.issued, forecast, yaw, inspection)


def _fitted(forecaster: Forecaster | str, known: WindSeries) -> Forecaster:
    if not isinstance(forecaster, str):
        return forecaster
    if forecaster.endswith(".npz"):
        return EdgeForecaster.load(forecaster)
    if forecaster not in FORECASTERS:
        names = ", ".join(FORECASTERS)
        expected = f"to be one of {names}, or a model's .npz file"
        raise InvalidInput("forecaster", expected, repr(forecaster))
    return FORECASTERS[forecaster]().fit(known)


def _last_direction(known: WindSeries) -> float:
    """Return the wind direction last measured [rad, met.]."""
    return float(known.theta_met[known.valid][-1])


def _yaw_steps(
    farm: Farm, forecast: WindForecast, *, start: float, method: str, seed: int
) -> tuple[Result[YawPlan], ...]:
    """Set-points for each step, every nacelle starting where the step before left it."""
    nacelle: float | Sequence[float] = start
    steps = []
    for wind in forecast.winds:
        result = plan_yaw(farm, wind, method=method, nacelle=nacelle, seed=seed)
        nacelle = [point.nacelle for point in result.found().set_points]
        steps.append(result)
    return tuple(steps)
