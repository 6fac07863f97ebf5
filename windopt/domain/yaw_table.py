"""Yaw tables: misalignments by wind direction and speed, as controllers look them up."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.steering import Steering
from windopt.errors import InvalidInput

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class YawTable:
    """The misalignments of n turbines at D directions and V speeds of the wind.

    Parameters
    ----------
    farm
        The wind farm.
    directions
        Where the wind blows from, clockwise from north [rad], shape ``(D,)``.
    speeds
        Wind speeds [m/s], shape ``(V,)``.
    yaw
        Misalignments [rad], in FLORIS's sign, shape ``(D, V, n)``.
    power, power_baseline, bound
        Power of the farm, its power with every nacelle facing the wind, and a proven bound on what
        any misalignments deliver [W], shape ``(D, V)``.
    steering
        What the farm is steered under.
    air_density
        Rho [kg/m3].
    """

    farm: Farm
    directions: Floats
    speeds: Floats
    yaw: Floats
    power: Floats
    power_baseline: Floats
    bound: Floats
    steering: Steering
    air_density: float

    def __post_init__(self) -> None:
        shape = len(self.directions), len(self.speeds)
        if self.yaw.shape != (*shape, len(self.farm)):
            raise InvalidInput("yaw", f"of shape {(*shape, len(self.farm))}", self.yaw.shape)
        for field in "power", "power_baseline", "bound":
            if getattr(self, field).shape != shape:
                raise InvalidInput(field, f"of shape {shape}", getattr(self, field).shape)

    @property
    def gain(self) -> float:
        """Mean power gained over the baseline, as a fraction of its mean [-]."""
        baseline = float(self.power_baseline.mean())
        return float(self.power.mean()) / baseline - 1 if baseline else 0.0
