"""Wind: a steady one, a measured series and a forecast.

Directions are meteorological where a person sees them: where the wind blows from, clockwise
from north. Inside, a wind is the velocity of the air, and the paper's two angles are related
by theta_pol = 3 pi / 2 - theta_met, wrapped to [0, 2 pi).
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import atan2, cos, hypot, inf, isfinite, pi, radians, sin
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windopt.domain.quantiles import Quantiles
from windopt.domain.turbine import require_finite
from windopt.errors import InvalidInput

Times = NDArray[np.datetime64]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Wind:
    """A steady wind: the velocity of the air, eastward and northward [m/s]."""

    u: float
    v: float

    def __post_init__(self) -> None:
        require_finite("wind u", self.u)
        require_finite("wind v", self.v)

    @classmethod
    def from_met(cls, speed: float, direction: float) -> "Wind":
        """Make a wind from what a weather station reports.

        Parameters
        ----------
        speed
            Wind speed w_s [m/s], not negative.
        direction
            Where it blows from [deg], clockwise from north; 90 is an east wind. Whole turns change
            nothing, so that offsets may be added freely: -90 and 630 are 270.
        """
        if not (isfinite(speed) and speed >= 0):
            raise InvalidInput("wind speed", "to be finite and >= 0 m/s", speed)
        require_finite("wind direction", direction)
        theta_pol = 1.5 * pi - radians(direction % 360.0)
        return cls(speed * cos(theta_pol), speed * sin(theta_pol))

    @property
    def speed(self) -> float:
        """Wind speed w_s [m/s]."""
        return hypot(self.u, self.v)

    @property
    def theta_pol(self) -> float:
        """Where it blows to, counter-clockwise from east [rad], in [0, 2 pi)."""
        return atan2(self.v, self.u) % (2 * pi)

    @property
    def theta_met(self) -> float:
        """Where it blows from, clockwise from north [rad], in [0, 2 pi)."""
        return (1.5 * pi - atan2(self.v, self.u)) % (2 * pi)

    @property
    def velocity(self) -> Floats:
        """The velocity of the air [m/s], shape ``(2,)``."""
        return np.array([self.u, self.v])


def _velocity(speed: Floats, theta_met: Floats) -> Floats:
    theta_pol = 1.5 * pi - theta_met
    return np.stack([speed * np.cos(theta_pol), speed * np.sin(theta_pol)], axis=-1)


@dataclass(frozen=True, eq=False)
class WindSeries:
    """Measured wind at equal steps; NaN where nothing valid was measured.

    Parameters
    ----------
    time
        Time stamps, shape ``(T,)``, increasing by one step each.
    speed
        Wind speed [m/s], shape ``(T,)``.
    theta_met
        Where it blows from, clockwise from north [rad], shape ``(T,)``.
    timezone
        Zone of the time stamps; empty where the source names none.
    source
        Where the series comes from.
    notes
        What the reader assumed, found or masked, one sentence each.
    """

    time: Times
    speed: Floats
    theta_met: Floats
    timezone: str = ""
    source: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        lengths = {len(self.time), len(self.speed), len(self.theta_met)}
        if len(lengths) > 1:
            raise InvalidInput("time, speed and direction", "to be equally long", sorted(lengths))
        if len(self.time) < 2:
            raise InvalidInput("wind series", "of at least 2 rows", len(self.time))
        steps = np.unique(np.diff(self.time))
        if len(steps) > 1 or steps[0] <= np.timedelta64(0):
            raise InvalidInput("time", "to increase by one equal step", f"steps of {steps[:5]}")
        if (self.speed < 0).any():
            raise InvalidInput("speed", ">= 0 m/s", self.speed[self.speed < 0][0])
        if np.isinf(self.speed).any() or np.isinf(self.theta_met).any():
            raise InvalidInput("speed and direction", "to be finite or missing", inf)

    @classmethod
    def read(
        cls, path: str | Path, *, time: str = "", speed: str = "", direction: str = ""
    ) -> "WindSeries":
        """Read a series from a CSV file, the WIND Toolkit's own format among them.

        Parameters
        ----------
        path
            The file, gzipped or not.
        time, speed, direction
            Names of the columns; those left out are recognised by usual names.

        Raises
        ------
        InvalidInput
            Naming the column that is missing or cannot be used.
        """
        from windopt.io.series import read_series  # the one door from the domain up to its readers

        return read_series(path, time=time, speed=speed, direction=direction)

    @property
    def step(self) -> np.timedelta64:
        """Time between two rows."""
        return np.timedelta64(self.time[1] - self.time[0])

    @property
    def step_seconds(self) -> float:
        """Time between two rows [s]."""
        return float(self.step / np.timedelta64(1, "s"))

    @cached_property
    def velocity(self) -> Floats:
        """Velocity of the air, eastward and northward [m/s], shape ``(T, 2)``."""
        return _velocity(self.speed, self.theta_met)

    @cached_property
    def valid(self) -> NDArray[np.bool_]:
        """Where both speed and direction are known, shape ``(T,)``."""
        return np.isfinite(self.speed) & np.isfinite(self.theta_met)

    def __len__(self) -> int:
        return len(self.time)

    def part(self, rows: slice) -> "WindSeries":
        """Return the rows ``rows``, which must follow each other."""
        return replace(
            self, time=self.time[rows], speed=self.speed[rows], theta_met=self.theta_met[rows]
        )

    def until(self, time: np.datetime64) -> "WindSeries":
        """Return what is known at ``time``: its own row and all before it.

        Raises
        ------
        InvalidInput
            If ``time`` lies outside the series.
        """
        if not self.time[0] <= time < self.time[-1] + self.step:
            span = f"between {self.time[0]} and {self.time[-1]}"
            raise InvalidInput("time", span, time)
        return self.part(slice(0, int(np.searchsorted(self.time, time, side="right"))))


@dataclass(frozen=True, eq=False)
class WindForecast:
    """The wind expected over the next steps.

    Parameters
    ----------
    issued
        Time of the last measurement used.
    time
        End of each step, shape ``(H,)``.
    speed
        Wind speed expected [m/s], shape ``(H,)``.
    theta_met
        Where it will blow from, clockwise from north [rad], shape ``(H,)``.
    method
        Name of the forecaster.
    notes
        What was assumed to make the forecast, one sentence each.
    quantiles
        How sure it is, where the forecaster says so.
    """

    issued: np.datetime64
    time: Times
    speed: Floats
    theta_met: Floats
    method: str
    notes: tuple[str, ...] = ()
    quantiles: Quantiles | None = None

    def __post_init__(self) -> None:
        if not len(self.time) == len(self.speed) == len(self.theta_met) > 0:
            raise InvalidInput("forecast", "of equally many times, speeds and directions", "others")
        if not (np.isfinite(self.speed).all() and np.isfinite(self.theta_met).all()):
            raise InvalidInput("forecast", "of finite speeds and directions", "NaN")

    @cached_property
    def velocity(self) -> Floats:
        """Velocity of the air, eastward and northward [m/s], shape ``(H, 2)``."""
        return _velocity(self.speed, self.theta_met)

    @property
    def winds(self) -> tuple[Wind, ...]:
        """The steady wind of each step."""
        return tuple(Wind(float(u), float(v)) for u, v in self.velocity)

    @property
    def mean(self) -> Wind:
        """The steady wind that moves the air as far as the forecast does."""
        u, v = self.velocity.mean(axis=0)
        return Wind(float(u), float(v))

    def scenarios(self, n: int, rng: np.random.Generator) -> tuple["WindForecast", ...]:
        """Draw ``n`` winds that may come, each a coherent path over the horizon.

        Raises
        ------
        InvalidInput
            If the forecaster gave no quantiles.
        """
        if self.quantiles is None:
            raise InvalidInput("forecast", "with quantiles to draw from", f"one by {self.method}")
        paths = zip(*self.quantiles.paths(n, rng), strict=True)
        return tuple(
            replace(self, speed=speed, theta_met=(self.theta_met + turn) % (2 * pi), quantiles=None)
            for speed, turn in paths
        )

    def __len__(self) -> int:
        return len(self.time)
