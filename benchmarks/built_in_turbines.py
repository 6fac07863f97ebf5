"""Make the built-in reference turbines from FLORIS's turbine library.

``python -m benchmarks.built_in_turbines`` needs FLORIS installed; its licence and what is taken
from it are in ``windopt/data/NOTICE.md``.
"""

from importlib.metadata import version
from importlib.resources import files
from typing import Any

import yaml

from windopt.io.floris import LIBRARY, TURBINES
from windopt.io.whole_files import write_whole

TABLE = (
    "ref_air_density",
    "cosine_loss_exponent_yaw",
    "wind_speed",
    "power",
    "thrust_coefficient",
)
HEADER = f"""\
# A reference turbine as FLORIS {version("floris")} (BSD 3-Clause) has it: m, kW, m/s, kg/m3.
# Made by benchmarks/built_in_turbines.py; see NOTICE.md in the folder above.
"""


def reduced(turbine: dict[str, Any]) -> dict[str, Any]:
    """Return what windopt reads of one of FLORIS's turbines."""
    table = turbine["power_thrust_table"]
    kept = {key: turbine[key] for key in ("turbine_type", "hub_height", "rotor_diameter")}
    return kept | {"power_thrust_table": {key: table[key] for key in TABLE}}


def main() -> None:
    """Write the files into the package."""
    TURBINES.mkdir(exist_ok=True)
    for name in LIBRARY:
        source = files("floris") / "turbine_library" / f"{name}.yaml"
        turbine = reduced(yaml.safe_load(source.read_text()))
        text = yaml.safe_dump(turbine, sort_keys=False, default_flow_style=None, width=100)
        write_whole(TURBINES / f"{name}.yaml", HEADER + text, force=True)


if __name__ == "__main__":
    main()
