"""Instances of wake steering: NREL 5MW turbines in the layouts and winds of the literature.

A name says it all: ``grid5x5-5D-272`` is 25 turbines 5 diameters apart in a wind of 8 m/s from
272 deg. ``table`` stands for 72 directions 5 deg apart, each with its own set-points; ``robust``
for one set-point in a scatter of 3 deg about 270 deg; ``steps`` for twelve steps between which a
nacelle turns by at most 3 deg.
"""

from dataclasses import dataclass
from functools import cache
from math import radians

import numpy as np
from numpy.typing import NDArray

from windopt.domain.farm import Farm
from windopt.domain.steering import Steering, yaw_problem
from windopt.domain.turbine import Turbine, TurbineType
from windopt.domain.wind import Wind
from windopt.domain.yaw_problem import YawProblem
from windopt.errors import InvalidInput
from windopt.io.turbines import load_turbine_type
from windopt.planning.yaw import curve_of

Floats = NDArray[np.float64]

SPEED = 8.0  # m/s
SCATTER = radians(3.0)
TURN = radians(3.0)
STEPS = 12
SEED = 0

DIRECTIONS = (270, 272, 275, 280)
HORNS_REV = (90, 135, 180, 222, 270, 275, 312, 350)
LAYOUTS = (
    "row3-5D-272",
    *(f"grid5x5-{spacing}D-{direction}" for spacing in (5, 6) for direction in DIRECTIONS),
    "random25-5D-280",
    "random50-5D-270",
)
LARGE = (*(f"hornsrev1-own-{direction}" for direction in HORNS_REV), "grid14x14-5D-275")
FURTHER = ("grid5x5-5D-table", "grid5x5-5D-robust", "grid5x5-5D-steps")


@dataclass(frozen=True)
class SteeredFarm:
    """One instance, by its name: layout, spacing, wind."""

    name: str

    @property
    def kind(self) -> str:
        """``"table"``, ``"robust"``, ``"steps"``, or the direction of the one wind [deg]."""
        return self.name.rpartition("-")[2]

    @property
    def problems(self) -> list[YawProblem]:
        """The problem of each direction or step; one, unless it is a table or has steps."""
        steering = Steering(direction_std=SCATTER if self.kind == "robust" else 0.0)
        farm = layout(self.name.rpartition("-")[0])
        return [
            yaw_problem(farm, Wind.from_met(SPEED, direction), steering, curve_of)
            for direction in self.directions
        ]

    @property
    def directions(self) -> list[float]:
        """Where the wind comes from [deg]."""
        if self.kind == "table":
            return list(np.arange(0.0, 360.0, 5.0))
        if self.kind == "robust":
            return [270.0]
        if self.kind == "steps":
            turns = np.random.default_rng(SEED).normal(0.0, 2.0, STEPS)
            return [float(direction) for direction in 270.0 + np.cumsum(turns)]
        return [float(self.kind)]


@cache
def layout(name: str) -> Farm:
    """Return a farm by name, such as ``grid5x5-5D``.

    Raises
    ------
    InvalidInput
        If there is no such farm.
    """
    form, _, spacing = name.partition("-")
    type_ = load_turbine_type("nrel_5MW")
    if form == "hornsrev1":
        return _farm(name, Farm.load("Horns Rev 1").xy, type_)
    distance = float(spacing.removesuffix("D")) * type_.rotor_diameter
    if form.startswith("random"):
        return _farm(name, distance * _scattered(int(form.removeprefix("random"))), type_)
    columns, _, rows = form.removeprefix("grid").removeprefix("row").partition("x")
    if not columns.isdigit():
        raise InvalidInput("layout", "a row, grid, random or hornsrev1", repr(name))
    xy = [(x, y) for x in range(int(columns)) for y in range(int(rows or 1))]
    return _farm(name, distance * np.array(xy, dtype=float), type_)


def _scattered(n: int) -> Floats:
    """Return n places as dense as a grid of spacing 1, none nearer than 0.6 to another."""
    rng = np.random.default_rng(SEED)
    placed: list[Floats] = []
    while len(placed) < n:
        at = rng.uniform(0.0, np.sqrt(n), 2)
        if all(np.hypot(*(at - other)) > 0.6 for other in placed):
            placed.append(at)
    return np.array(placed)


def _farm(name: str, xy: Floats, type_: TurbineType) -> Farm:
    turbines = (Turbine(f"T{i}", float(x), float(y), type_) for i, (x, y) in enumerate(xy, 1))
    return Farm(name, tuple(turbines))
