"""How a farm is steered: which winds count, how far rotors may turn in them, and how fast."""

from collections.abc import Callable
from dataclasses import dataclass
from math import exp, inf, isfinite, pi, radians

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.power_curve import STANDARD_AIR_DENSITY, PowerCurve
from windopt.domain.turbine import TurbineType, require_not_negative, require_positive
from windopt.domain.wind import Wind
from windopt.domain.yaw_problem import SHEAR, YawProblem
from windopt.errors import InvalidInput

SIGMAS = (-2.0, -1.0, 0.0, 1.0, 2.0)
"""Standard deviations at which a scatter of directions is sampled: FLORIS's default."""


@dataclass(frozen=True)
class Steering:
    """What a steered farm is exposed to and held within.

    Parameters
    ----------
    turbulence
        Ambient turbulence intensity [-].
    lower, upper
        Bounds of every misalignment [rad], in FLORIS's sign.
    direction_std
        Standard deviation of the wind's direction around the one given [rad]; 0 for none.
    scenarios
        Winds that may come and their weights, in place of the one given and its scatter.
    farm_cap
        The most the grid takes from the farm [W].
    shear
        Exponent of the wind's growth with height [-]; winds hold at the mean hub height.
    """

    turbulence: float = 0.06
    lower: float = radians(-25.0)
    upper: float = radians(25.0)
    direction_std: float = 0.0
    scenarios: tuple[tuple[Wind, float], ...] = ()
    farm_cap: float = inf
    shear: float = SHEAR

    def __post_init__(self) -> None:
        require_positive("turbulence", self.turbulence)
        if self.turbulence >= 1:
            raise InvalidInput("turbulence", "to be a share below 1, 0.06 for 6 %", self.turbulence)
        require_not_negative("farm_cap", self.farm_cap)
        for field in "direction_std", "shear":
            require_not_negative(field, getattr(self, field))
            if not isfinite(getattr(self, field)):
                raise InvalidInput(field, "to be finite", inf)
        if not -pi / 2 < self.lower <= self.upper < pi / 2:
            bounds = np.degrees([self.lower, self.upper]).round(6).tolist()
            raise InvalidInput("bounds", "between -90 and 90 deg, the lower first", bounds)
        weights = [weight for _, weight in self.scenarios]
        if weights and not (min(weights) >= 0 and abs(sum(weights) - 1) < 1e-9):
            raise InvalidInput("weights of the scenarios", ">= 0 with sum 1", sum(weights))

    def winds(self, wind: Wind) -> tuple[NDArray[np.float64], ...]:
        """Return speeds [m/s], directions [rad] and weights of all that may come for ``wind``."""
        if self.scenarios:
            rows = [(w.speed, w.theta_met, weight) for w, weight in self.scenarios]
        elif self.direction_std:
            turns = [wind.theta_met + s * self.direction_std for s in SIGMAS]
            total = sum(exp(-(s**2) / 2) for s in SIGMAS)
            weights = [exp(-(s**2) / 2) / total for s in SIGMAS]
            rows = [(wind.speed, turn, w) for turn, w in zip(turns, weights, strict=True)]
        else:
            rows = [(wind.speed, wind.theta_met, 1.0)]
        return tuple(np.array(column) for column in zip(*rows, strict=True))


@dataclass(frozen=True)
class Pace:
    """How nacelles turn between the steps of a schedule.

    Parameters
    ----------
    rate
        How fast they turn at most [rad/s].
    threshold
        Gain in the farm's power, as a fraction of it, below which they stay where they are [-].
    """

    rate: float = radians(0.3)
    threshold: float = 0.001

    def __post_init__(self) -> None:
        if not self.rate > 0:
            raise InvalidInput("rate", "> 0 rad/s", self.rate)
        require_not_negative("threshold", self.threshold)
        if not isfinite(self.threshold):
            raise InvalidInput("threshold", "to be finite", self.threshold)


def yaw_problem(
    farm: Farm,
    wind: Wind,
    steering: Steering,
    curve: Callable[[TurbineType], PowerCurve],
    *,
    air_density: float = STANDARD_AIR_DENSITY,
    present: NDArray[np.float64] | None = None,
) -> YawProblem:
    """Return the farm's yaw problem in numbers.

    Parameters
    ----------
    wind
        The steady wind, or the one about which it scatters.
    curve
        Power and thrust of a turbine type.
    air_density
        Rho [kg/m3].
    present
        Misalignments at present [rad], shape ``(n,)``.
    """
    types = [turbine.type for turbine in farm.turbines]
    of_type = {type_: curve(type_) for type_ in dict.fromkeys(types)}
    curves = tuple(dict.fromkeys(of_type.values()))
    speeds, directions, weights = steering.winds(wind)
    n = len(farm)
    return YawProblem(
        farm.xy,
        curves,
        np.array([curves.index(of_type[type_]) for type_ in types]),
        np.array([type_.rotor_diameter for type_ in types]),
        np.array([type_.height for type_ in types]),
        speeds,
        directions,
        weights,
        steering.turbulence,
        np.full(n, steering.lower),
        np.full(n, steering.upper),
        farm_cap=steering.farm_cap,
        air_density=air_density,
        shear=steering.shear,
        present=present,
    )
