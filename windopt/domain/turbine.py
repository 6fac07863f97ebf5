"""A wind turbine: where it stands and what its rotor can do."""

from dataclasses import dataclass, replace
from math import isfinite, pi, sqrt
from numbers import Real

from windopt.domain.power_curve import PowerCurve
from windopt.errors import InvalidInput

CLEARANCE = 30.0
"""Between the sea and the blades where a source is silent [m]; Horns Rev 1's V80 stand at 70 m."""


def require_positive(field: str, value: float) -> None:
    """Raise unless ``value`` is a positive, finite number."""
    require_finite(field, value)
    if not value > 0:
        raise InvalidInput(field, "> 0", value)


def require_not_negative(field: str, value: object) -> None:
    """Raise unless ``value`` is zero, positive or infinite."""
    if not (isinstance(value, Real) and float(value) >= 0):
        raise InvalidInput(field, ">= 0", value)


def require_finite(field: str, value: object) -> None:
    """Raise unless ``value`` is a finite number."""
    if not (isinstance(value, Real) and isfinite(value)):
        raise InvalidInput(field, "to be a finite number", repr(value))


@dataclass(frozen=True)
class TurbineType:
    """What turbines of one make have in common.

    Parameters
    ----------
    name
        Make and model.
    rated_power
        The most the generator may deliver [W].
    swept_area
        Area swept by the blades [m2].
    cut_in, cut_out
        Wind speeds between which the turbine runs [m/s].
    hub_height
        Height of the rotor's centre above the sea [m]; ``None`` where the source is silent.
    power_coefficient
        Name of the C_p model, one of ``formulations.rotor.MODELS``.
    curve
        Its power and thrust over the wind speed; ``None`` where nothing is published, and then
        they follow from the C_p model: :meth:`windopt.domain.power_curve.PowerCurve.stand_in`.
    """

    name: str
    rated_power: float
    swept_area: float
    cut_in: float = 3.0
    cut_out: float = 25.0
    hub_height: float | None = None
    power_coefficient: str = "slootweg"
    curve: PowerCurve | None = None

    def __post_init__(self) -> None:
        require_positive("rated_power", self.rated_power)
        require_positive("swept_area", self.swept_area)
        require_positive("cut_in", self.cut_in)
        require_positive("cut_out", self.cut_out)
        if self.cut_in >= self.cut_out:
            raise InvalidInput("cut_in", f"below cut_out = {self.cut_out}", self.cut_in)
        if self.hub_height is not None:
            require_positive("hub_height", self.hub_height)

    @property
    def rotor_diameter(self) -> float:
        """Diameter of the circle swept by the blades [m]."""
        return sqrt(4 * self.swept_area / pi)

    @property
    def height(self) -> float:
        """Height of the rotor's centre [m]; a usual one where the source is silent."""
        return self.hub_height or self.rotor_diameter / 2 + CLEARANCE

    def curve_by(self, C_p: float) -> PowerCurve:
        """Return the turbine's curve, or the one that its largest power coefficient gives."""
        return self.curve or PowerCurve.stand_in(
            C_p, self.swept_area, self.rated_power, self.cut_in, self.cut_out
        )

    def scaled_to(self, rated_power: float) -> "TurbineType":
        """Return a turbine of ``rated_power`` [W] with this one's power per swept area.

        Used where a source gives a farm's rated power and not its rotors: at the SG 8.0-167's
        365 W/m2 a 2 MW turbine gets 83 m and a 7 MW one 156 m, against 80 m (V80) and 154 m
        (SWT-7.0-154) in reality.
        """
        area = self.swept_area * rated_power / self.rated_power
        name = f"{rated_power / 1e6:g} MW, rotor scaled from {self.name}"
        curve = self.curve and self.curve.scaled(rated_power / self.rated_power)
        scaled = replace(self, name=name, rated_power=rated_power, swept_area=area, curve=curve)
        return replace(scaled, hub_height=None)


SG_8_167 = TurbineType("SG 8.0-167 DD", rated_power=8e6, swept_area=21_900.0)
"""The paper's turbine; cut-in and cut-out are usual values for machines of 8 MW."""


@dataclass(frozen=True)
class Turbine:
    """One turbine of a farm.

    Parameters
    ----------
    name
        As the farm's operator names it.
    x, y
        Easting and northing in the farm's CRS [m].
    type
        Its make.
    """

    name: str
    x: float
    y: float
    type: TurbineType = SG_8_167

    def __post_init__(self) -> None:
        if not self.name:
            raise InvalidInput("turbine name", "to be a non-empty string", repr(self.name))
        require_finite(f"x of turbine {self.name}", self.x)
        require_finite(f"y of turbine {self.name}", self.y)
