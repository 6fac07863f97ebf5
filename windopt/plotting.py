"""Pictures of farms, flights, set-points and forecasts: an Axes in, the same Axes out.

Needs matplotlib, the extra ``plot``. Positions are drawn in kilometres, directions in degrees.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.plan import Flight, InspectionPlan, YawPlan
from windopt.domain.wind import Wind, WindForecast, WindSeries
from windopt.errors import MissingExtra
from windopt.planning.yaw import problem_of
from windopt.wakes.farm import turbine_powers
from windopt.wakes.plane import wind_speeds

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Okabe & Ito's palette, told apart by the colour-blind as well.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
KILOMETRE = 1e3
PIXELS = 250  # of a picture of wakes, along each side

Floats = NDArray[np.float64]


def axes() -> "Axes":
    """Return new Axes to draw on.

    Raises
    ------
    MissingExtra
        If matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingExtra("A picture", "plot") from None
    return Figure(figsize=(9, 7), layout="constrained").add_subplot()


def plot_farm(farm: Farm, ax: "Axes") -> "Axes":
    """Draw the turbines of a farm and its substations."""
    x, y = farm.xy.T / KILOMETRE
    ax.plot(x, y, "o", ms=3, color="0.45", label="turbine")
    if farm.substations:
        x, y = np.array(farm.substations).T / KILOMETRE
        ax.plot(x, y, "D", ms=5, color="0.2", label="substation")
    ax.set(xlabel="easting (km)", ylabel="northing (km)", title=farm.name, aspect="equal")
    ax.ticklabel_format(useOffset=False)
    return ax


def plot_flights(plan: InspectionPlan, ax: "Axes") -> "Axes":
    """Draw the flights of a plan over its farm, a colour for each station."""
    plot_farm(plan.farm, ax)
    colour = dict(zip(plan.fleet.names, cycle(COLOURS), strict=False))
    for flight in plan.flights:
        x, y = np.array(list(_stops(flight, plan))).T / KILOMETRE
        ax.plot(x, y, "-", lw=1.2, color=colour[flight.station])
    for station in plan.fleet.stations:
        place = station.x / KILOMETRE, station.y / KILOMETRE
        ax.plot(*place, "s", ms=8, mec="white", color=colour[station.name])
        ax.annotate(station.name, place, xytext=(5, 5), textcoords="offset points")
    places = dict(zip(plan.farm.names, plan.farm.xy / KILOMETRE, strict=True))
    for left_out in plan.unreachable:
        ax.plot(*places[left_out.turbine], "x", ms=8, color="crimson")
    hours = plan.duration / 3600
    ax.set_title(f"{plan.farm.name}: {len(plan.flights)} flights, {hours:.2f} h in the air")
    return plot_wind(plan.wind, ax)


def _stops(flight: Flight, plan: InspectionPlan) -> Iterator[tuple[float, float]]:
    """Yield the places of a flight in order, its station first and last."""
    station = next(s for s in plan.fleet.stations if s.name == flight.station)
    turbines = {turbine.name: turbine for turbine in plan.farm.turbines}
    yield station.x, station.y
    yield from ((turbines[name].x, turbines[name].y) for name in flight.turbines)
    yield station.x, station.y


def plot_wind(wind: Wind, ax: "Axes") -> "Axes":
    """Draw the wind as an arrow in the upper right corner."""
    towards = [cos(wind.theta_pol)], [sin(wind.theta_pol)]
    ax.quiver(
        *([0.93], [0.92]),
        *towards,
        transform=ax.transAxes,
        pivot="mid",
        scale=2.5,
        scale_units="inches",
        width=0.006,
        color=COLOURS[0],
    )
    text = f"{wind.speed:.1f} m/s from {np.degrees(wind.theta_met):.0f}°"
    ax.text(0.98, 0.82, text, transform=ax.transAxes, ha="right", color=COLOURS[0])
    return ax


def plot_yaw(plan: YawPlan, ax: "Axes") -> "Axes":
    """Draw each nacelle as the line of its rotor, coloured by the power delivered."""
    plot_farm(plan.farm, ax)
    x, y = plan.farm.xy.T / KILOMETRE
    nacelle = np.array([point.nacelle for point in plan.set_points])
    power = np.array([point.power for point in plan.set_points]) / 1e6
    rotors = ax.quiver(
        x,
        y,
        np.cos(nacelle),
        -np.sin(nacelle),
        power,
        cmap="viridis",
        pivot="mid",
        headaxislength=0,
        headlength=0,
        headwidth=1,
        width=0.004,
        scale=45,
    )
    ax.figure.colorbar(rotors, ax=ax, label="power (MW)", shrink=0.7)
    ax.set_title(f"{plan.farm.name}: {plan.power / 1e6:.1f} MW")
    return plot_wind(plan.wind, ax)


def plot_wakes(plan: YawPlan, ax: "Axes") -> "Axes":
    """Draw the wind at hub height under the set-points of a plan, in its mean wind."""
    return _wakes(plan, np.array([point.misalignment for point in plan.set_points]), ax)


def plot_facing_wakes(plan: YawPlan, ax: "Axes") -> "Axes":
    """Draw the same wind with every nacelle facing it: the wakes before the plan."""
    return _wakes(plan, np.zeros(len(plan.farm)), ax)


def _wakes(plan: YawPlan, gamma: Floats, ax: "Axes") -> "Axes":
    problem = replace(
        problem_of(plan),
        wind_speeds=np.array([plan.wind.speed]),
        wind_directions=np.array([plan.wind.theta_met]),
        weights=np.ones(1),
    )
    low, high = plan.farm.xy.min(axis=0), plan.farm.xy.max(axis=0)
    margin = 0.05 * (high - low).max() + 3 * problem.rotor_diameters.max()
    x, y = (np.linspace(a - margin, b + margin, PIXELS) for a, b in zip(low, high, strict=True))
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    speeds = np.maximum(wind_speeds(problem, gamma, places), 0.0).reshape(PIXELS, PIXELS)
    image = ax.pcolormesh(
        x / KILOMETRE, y / KILOMETRE, speeds, cmap="Blues_r", shading="nearest", rasterized=True
    )
    ax.figure.colorbar(image, ax=ax, label="wind speed (m/s)", shrink=0.7)
    across = plan.wind.theta_met - gamma
    ends = problem.rotor_diameters[:, None] / 2 * np.c_[np.cos(across), -np.sin(across)]
    for one, other in zip(plan.farm.xy - ends, plan.farm.xy + ends, strict=True):
        ax.plot(*(np.array([one, other]).T / KILOMETRE), "-", lw=1.2, color="black")
    power = float(turbine_powers(problem, gamma).sum()) / 1e6
    ax.set(xlabel="easting (km)", ylabel="northing (km)", aspect="equal")
    ax.set_title(f"{plan.farm.name}: {power:.1f} MW")
    ax.ticklabel_format(useOffset=False)
    return plot_wind(plan.wind, ax)


def plot_forecast(series: WindSeries, forecast: WindForecast, ax: "Axes") -> "Axes":
    """Draw the speeds last measured and those forecast, with directions as arrows."""
    measured = series.until(forecast.issued)
    recent = measured.part(slice(max(0, len(measured) - 3 * len(forecast)), len(measured)))
    ax.plot(recent.time, recent.speed, "o-", ms=3, color="0.45", label="measured")
    ax.plot(forecast.time, forecast.speed, "o-", ms=3, color=COLOURS[1], label=forecast.method)
    u, v = (forecast.velocity / np.maximum(forecast.speed, 1e-9)[:, None]).T
    ax.quiver(forecast.time, forecast.speed, u, v, color=COLOURS[1], width=0.004, scale=25)
    ax.set(xlabel="time", ylabel="wind speed (m/s)", title=f"Forecast issued {forecast.issued}")
    ax.margins(y=0.3)
    ax.legend()
    return ax
