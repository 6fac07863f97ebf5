"""Farms by name or from a file."""

from pathlib import Path

from windopt.domain.farm import Farm
from windopt.errors import InvalidInput
from windopt.io.built_in import WALNEY, built_in_farm
from windopt.io.farm_csv import farm_from_csv
from windopt.io.floris import farm_from_floris, is_floris
from windopt.io.optiwindnet import optiwindnet_farm
from windopt.io.windio import farm_from_windio, is_windio
from windopt.io.yaml_files import read_yaml

TABLES = (".csv", ".csv.gz")
DOCUMENTS = (".yaml", ".yml")


def load_farm(source: str | Path) -> Farm:
    """Load a farm by name or from a file; see :meth:`windopt.Farm.load`."""
    name = str(source).lower()
    if name.endswith(TABLES):
        return farm_from_csv(source)
    if name.endswith(DOCUMENTS):
        return farm_from_yaml(source)
    if isinstance(source, Path) or Path(source).is_file():
        raise InvalidInput("farm file", f"to end in {', '.join((*DOCUMENTS, *TABLES))}", source)
    if name.strip() == WALNEY.lower():
        return built_in_farm()
    return optiwindnet_farm(source)


def farm_from_yaml(path: str | Path) -> Farm:
    """Read a farm from a YAML file: windIO 2 or FLORIS v4, recognised by its keys."""
    document = read_yaml(path)
    if is_windio(document):
        return farm_from_windio(document, str(path))
    if is_floris(document):
        return farm_from_floris(document, str(path))
    raise InvalidInput(Path(path).name, "to hold windIO's layouts or FLORIS's farm", "neither")
