"""Farms of the OptiWindNet repository: about 110 real layouts and a few from the literature."""

import warnings
from collections.abc import Mapping
from difflib import get_close_matches
from functools import cache
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.turbine import Turbine
from windopt.errors import InvalidInput, MissingExtra
from windopt.io.built_in import WALNEY
from windopt.io.coordinates import utm_crs
from windopt.io.turbine_names import distinct_names
from windopt.io.turbine_types import types_by_rating

SMALLEST_EXTENT = 100.0  # m; below it the numbers cannot be metres


@cache
def _repository() -> tuple[Any, ...]:
    # Only the importer: the rest of OptiWindNet loads OR-tools, which cannot share a process
    # with HiGHS.
    from optiwindnet.importer import load_repository

    with warnings.catch_warnings():  # it leaves its files to be closed by the garbage collector
        warnings.simplefilter("ignore", ResourceWarning)
        return tuple(load_repository())


def _graphs(feature: str) -> tuple[Any, ...]:
    """Return OptiWindNet's farms, or say that ``feature`` needs them."""
    try:
        return _repository()
    except ModuleNotFoundError as missing:
        if missing.name != "optiwindnet":
            raise
        raise MissingExtra(feature, "farms") from None


def optiwindnet_farm(name: str) -> Farm:
    """Load one of OptiWindNet's farms.

    Parameters
    ----------
    name
        The farm's name or handle, such as ``"Horns Rev 1"`` or ``"horns"``; case does not matter.

    Raises
    ------
    InvalidInput
        If no farm is so called, with the names that come close and where all are listed.
    MissingExtra
        If OptiWindNet is not installed.
    """
    unknown = f"No file is called {name!r} and only {WALNEY} is built in; a farm of OptiWindNet"
    farms: dict[str, Any] = {}
    for graph in _graphs(unknown):
        farms.setdefault(graph.graph["handle"].casefold(), graph)
        farms[graph.graph["name"].casefold()] = graph
    key = name.strip().casefold()
    if key not in farms:
        names = {word: graph.graph["name"] for word, graph in farms.items()}
        raise InvalidInput("farm", _expected(key, names | {WALNEY.casefold(): WALNEY}), repr(name))
    return _farm(farms[key])


def _expected(key: str, names: Mapping[str, str]) -> str:
    """Return what a farm may be, with the names of those that are written much like ``key``."""
    close = dict.fromkeys(names[word] for word in get_close_matches(key, names, n=5))
    alike = f"like {', '.join(close)}; " if close else ""
    listed = "`windopt farms` lists all"
    return (
        f"to be a file that exists, {WALNEY} (built in) or the name of a farm of OptiWindNet "
        f"({alike}{listed})"
    )


class ListedFarm(NamedTuple):
    """A farm that can be loaded by name.

    Attributes
    ----------
    name, handle
        What it is called, and a short form of that.
    turbines
        How many it has.
    on_map
        Whether it is known where on Earth they stand.
    """

    name: str
    handle: str
    turbines: int
    on_map: bool


def optiwindnet_farms() -> tuple[ListedFarm, ...]:
    """Return OptiWindNet's farms, in order of the alphabet.

    Raises
    ------
    MissingExtra
        If OptiWindNet is not installed.
    """
    facts = (graph.graph for graph in _graphs("A list of farms"))
    return tuple(
        sorted(
            ListedFarm(farm["name"], farm["handle"], farm["T"], "utm_zone_number" in farm)
            for farm in facts
        )
    )


def optiwindnet_names() -> tuple[str, ...]:
    """Return the names of OptiWindNet's farms, in order of the alphabet."""
    return tuple(farm.name for farm in optiwindnet_farms())


def optiwindnet_sizes() -> dict[str, int]:
    """Return how many turbines each of OptiWindNet's farms has that stand on the map, by handle."""
    return {farm.handle: farm.turbines for farm in optiwindnet_farms() if farm.on_map}


def _farm(graph: Any) -> Farm:
    """Translate OptiWindNet's graph: turbines first in ``VertexC``, substations last."""
    facts = graph.graph
    n, substations = facts["T"], facts["R"]
    xy = np.asarray(facts["VertexC"], dtype=float)
    nodes = [graph.nodes[i] for i in range(n)]
    powers = [node.get("power") or facts.get("power_per_inflow") for node in nodes]
    names, name_notes = distinct_names([node.get("label") for node in nodes])
    types, type_notes = types_by_rating([float(p) * 1e6 if p else None for p in powers])

    crs, notes = None, [*name_notes, *type_notes]
    if "utm_zone_number" in facts:
        crs = utm_crs(facts["utm_zone_number"], facts["utm_zone_letter"])
    else:
        notes.append("The source names no coordinate system.")
    if np.ptp(xy[:n], axis=0).max() < SMALLEST_EXTENT:
        notes.append("The coordinates are too small to be metres; they are kept as they are.")
    return Farm(
        facts["name"],
        tuple(Turbine(*row) for row in zip(names, *xy[:n].T.tolist(), types, strict=True)),
        crs=crs,
        substations=tuple((x, y) for x, y in xy[len(xy) - substations :].tolist()),
        source=f"OptiWindNet {version('optiwindnet')}, {facts['handle']}",
        notes=tuple(notes),
    )
