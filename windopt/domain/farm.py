"""A wind farm: its turbines and the coordinate system they stand in."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windopt.domain.turbine import Turbine, TurbineType
from windopt.errors import InvalidInput


def require_distinct(field: str, names: Iterable[str]) -> None:
    """Raise if a name occurs twice."""
    repeated = [name for name, count in Counter(names).items() if count > 1]
    if repeated:
        raise InvalidInput(field, "to be distinct", f"{', '.join(repeated[:5])} more than once")


@dataclass(frozen=True)
class Farm:
    """A wind farm.

    Parameters
    ----------
    name
        As people call it.
    turbines
        At least one, with distinct names.
    crs
        The projected coordinate system of all positions, such as ``"EPSG:32631"``;
        ``None`` where the source gives none, and then exports have no longitude and latitude.
    substations
        Positions of the offshore substations [m], where the source gives them.
    source
        Where the layout comes from.
    notes
        What the reader assumed or found, one sentence each.
    """

    name: str
    turbines: tuple[Turbine, ...]
    crs: str | None = None
    substations: tuple[tuple[float, float], ...] = ()
    source: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not self.turbines:
            raise InvalidInput("turbines", "to name at least one turbine", "an empty farm")
        require_distinct("turbine names", self.names)

    @classmethod
    def load(cls, source: str | Path) -> "Farm":
        """Load a farm by name or from a file.

        Parameters
        ----------
        source
            ``"Walney"`` (built in), the name or handle of one of OptiWindNet's real farms (extra
            ``farms``), or a windIO YAML, FLORIS v4 YAML or CSV file.

        Raises
        ------
        InvalidInput
            Naming the field of the file that cannot be used, or the names that resemble ``source``.
        """
        from windopt.io.farms import load_farm  # the one door from the domain up to its readers

        return load_farm(source)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the turbines, in order."""
        return tuple(turbine.name for turbine in self.turbines)

    @cached_property
    def xy(self) -> NDArray[np.float64]:
        """Positions of the turbines [m], shape ``(n, 2)``."""
        xy = np.array([(turbine.x, turbine.y) for turbine in self.turbines], dtype=float)
        xy.flags.writeable = False
        return xy

    def __len__(self) -> int:
        return len(self.turbines)

    def with_turbine_type(self, type_: TurbineType) -> "Farm":
        """Return the farm with turbines of one type throughout."""
        return replace(self, turbines=tuple(replace(t, type=type_) for t in self.turbines))

    def with_power_coefficient(self, model: str) -> "Farm":
        """Return the farm with every turbine's power coefficient by another C_p model."""
        return replace(
            self,
            turbines=tuple(
                replace(turbine, type=replace(turbine.type, power_coefficient=model))
                for turbine in self.turbines
            ),
        )
