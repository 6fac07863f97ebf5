"""Turbine types by name or from a file."""

from pathlib import Path

from windopt.domain.turbine import SG_8_167, TurbineType
from windopt.errors import InvalidInput
from windopt.io import floris, windio
from windopt.io.entries import Entry
from windopt.io.yaml_files import read_yaml

BUILT_IN = (SG_8_167.name, *floris.LIBRARY)


def load_turbine_type(source: str | Path) -> TurbineType:
    """Return a turbine type.

    Parameters
    ----------
    source
        ``"SG 8.0-167 DD"``, one of FLORIS's library such as ``"nrel_5MW"``, or a YAML file: one of
        FLORIS's turbine definitions or one of windIO's turbines.

    Raises
    ------
    InvalidInput
        Naming the key that cannot be used, or the names that are known.
    """
    if str(source) == SG_8_167.name:
        return SG_8_167
    if str(source) in floris.LIBRARY:
        return floris.library_turbine(str(source))
    if Path(source).suffix.lower() not in (".yaml", ".yml"):
        raise InvalidInput("turbine", f"to be a YAML file or one of {', '.join(BUILT_IN)}", source)
    entry = Entry(read_yaml(source))
    if "power_thrust_table" in entry:
        return floris.turbine_type(entry)
    if "performance" in entry:
        return windio.turbine_type(entry)
    expected = "to hold FLORIS's power_thrust_table or windIO's performance"
    raise InvalidInput(Path(source).name, expected, "neither")
