"""The farm's yaw problem in numbers: what every method of wake steering takes."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf, isfinite

import numpy as np
from numpy.typing import NDArray

from windopt.domain.power_curve import STANDARD_AIR_DENSITY, PowerCurve
from windopt.domain.turbine import require_positive
from windopt.errors import InvalidInput

Floats = NDArray[np.float64]

ROTOR_POINTS = np.array([-0.25, 0.0, 0.25])
"""Where a rotor feels the wind, sideways and upwards, in diameters from its centre: FLORIS's grid
of 3 by 3 points."""

SHEAR = 0.12
"""FLORIS's default exponent of the wind's growth with height [-]."""

GAP = 1e-6
"""Relative distance to its bound at which a set-point counts as proved optimal."""

STRONGEST = 1000.0
"""No wind is as strong [m/s]; beyond, cubes of it might overflow."""


@dataclass(frozen=True, eq=False)
class YawProblem:
    """n turbines, S winds with their weights, and how far the rotors may turn.

    The decision is a misalignment for each turbine [rad], shape ``(n,)``, held in all winds. Its
    sign is FLORIS's: wind direction minus nacelle direction, so a positive one turns the nacelle
    counter-clockwise as seen from above. A single steady wind is S = 1; several are a forecast's
    spread or a scatter of directions, and the objective is the weighted mean of the farm's power.

    Parameters
    ----------
    turbines
        Easting and northing [m], shape ``(n, 2)``.
    curves
        The distinct power curves.
    curve_of
        Which of them each turbine has, shape ``(n,)``.
    rotor_diameters, hub_heights
        [m], shape ``(n,)``.
    wind_speeds
        At the reference height [m/s], shape ``(S,)``.
    wind_directions
        Where the wind blows from, clockwise from north [rad], shape ``(S,)``. With several of
        them the nacelles keep their misalignment with the wind as it turns.
    weights
        Of the winds, summing to 1, shape ``(S,)``.
    turbulence
        Ambient turbulence intensity [-].
    lower, upper
        Bounds of the misalignments [rad], shape ``(n,)``.
    farm_cap
        The most the grid takes from the farm [W]; turbines are curtailed to keep it.
    air_density
        Rho [kg/m3].
    shear
        Exponent of the wind's growth with height [-].
    reference_height
        Height of the wind speeds [m]; unless given, the mean hub height.
    present
        Misalignments at present [rad], shape ``(n,)``, where a method may hold on to them.
    """

    turbines: Floats
    curves: tuple[PowerCurve, ...]
    curve_of: NDArray[np.intp]
    rotor_diameters: Floats
    hub_heights: Floats
    wind_speeds: Floats
    wind_directions: Floats
    weights: Floats
    turbulence: float
    lower: Floats
    upper: Floats
    farm_cap: float = inf
    air_density: float = STANDARD_AIR_DENSITY
    shear: float = SHEAR
    reference_height: float = field(default=0.0)
    present: Floats | None = None

    def __post_init__(self) -> None:
        if not self.reference_height:
            object.__setattr__(self, "reference_height", float(np.mean(self.hub_heights)))
        self._require_shapes()
        self._require_ranges()

    def _require_shapes(self) -> None:
        n, S = len(self.turbines), len(self.wind_speeds)
        if not (n and S):
            raise InvalidInput("turbines and wind_speeds", "to be one at least", (n, S))
        shapes: dict[str, tuple[int, ...]] = dict.fromkeys(
            ("curve_of", "rotor_diameters", "hub_heights", "lower", "upper"), (n,)
        )
        shapes |= dict.fromkeys(("wind_speeds", "wind_directions", "weights"), (S,))
        shapes |= {"turbines": (n, 2)} | ({} if self.present is None else {"present": (n,)})
        for name, shape in shapes.items():
            values = getattr(self, name)
            if values.shape != shape:
                raise InvalidInput(name, f"of shape {shape}", values.shape)
            if not np.isfinite(values).all():
                raise InvalidInput(name, "to be finite", "NaN or infinity")

    def _require_ranges(self) -> None:
        for name in "turbulence", "air_density", "reference_height":
            require_positive(name, getattr(self, name))
        if not (isfinite(self.shear) and self.shear >= 0):
            raise InvalidInput("shear", ">= 0", self.shear)
        if not self.farm_cap >= 0:
            raise InvalidInput("farm_cap", ">= 0 W", self.farm_cap)
        if not ((self.curve_of >= 0) & (self.curve_of < len(self.curves))).all():
            raise InvalidInput("curve_of", f"to count {len(self.curves)} curves", self.curve_of)
        if not (self.rotor_diameters > 0).all():
            raise InvalidInput("rotor_diameters", "> 0", self.rotor_diameters.min())
        if not (self.hub_heights > self.rotor_diameters / 2).all():
            raise InvalidInput("hub_heights", "above half the rotor", self.hub_heights.min())
        if not ((self.wind_speeds >= 0) & (self.wind_speeds < STRONGEST)).all():
            raise InvalidInput("wind_speeds", f"from 0 to {STRONGEST:g} m/s", self.wind_speeds)
        if not (self.weights >= 0).all() or abs(self.weights.sum() - 1) > 1e-9:
            raise InvalidInput("weights", ">= 0 with sum 1", self.weights.sum())
        if not ((-np.pi / 2 < self.lower) & (self.lower <= self.upper)).all():
            raise InvalidInput(
                "lower", "above -90 deg and up to upper", np.degrees(self.lower.min())
            )
        if not (self.upper < np.pi / 2).all():
            raise InvalidInput("upper", "below 90 deg", np.degrees(self.upper.max()))

    def __len__(self) -> int:
        return len(self.turbines)

    @property
    def facing(self) -> Floats:
        """The allowed misalignments nearest to facing the wind [rad], shape ``(n,)``."""
        return np.minimum(np.maximum(0.0, self.lower), self.upper)

    @cached_property
    def unwaked(self) -> Floats:
        """The most that each turbine delivers in each wind without wakes [W], shape ``(S, n)``.

        Wakes only slow the wind and yaw only takes from it, so no misalignments deliver more.
        """
        heights = self.hub_heights[:, None] + self.rotor_diameters[:, None] * ROTOR_POINTS
        profile = np.cbrt(((heights / self.reference_height) ** (3 * self.shear)).mean(axis=1))
        return np.array(
            [[self._most(i, w * profile[i]) for i in range(len(self))] for w in self.wind_speeds]
        )

    def _most(self, i: int, v: float) -> float:
        curve = self.curves[int(self.curve_of[i])]
        density = float((self.air_density / curve.air_density) ** (1 / 3))
        return curve.most(density * v)

    @property
    def bound(self) -> float:
        """A proven bound on the objective [W]: every turbine unwaked, within the farm's cap."""
        return float(self.weights @ np.minimum(self.unwaked.sum(axis=1), self.farm_cap))

    def between(self, lower: Floats, upper: Floats) -> "YawProblem":
        """Return the same problem within other bounds [rad]."""
        return replace(self, lower=lower, upper=upper)
