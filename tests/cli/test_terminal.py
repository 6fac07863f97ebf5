"""What a person is told."""

from dataclasses import replace
from math import radians

import pytest

from windopt.cli.terminal import facing
from windopt.domain.farm import Farm
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.planning.yaw import plan_yaw

FARM = Farm("Row", (Turbine("A", 0.0, 0.0), Turbine("B", 900.0, 0.0)))


@pytest.mark.parametrize(("wind", "told"), [(100.0, "95.0 to 105.0"), (2.0, "357.0 to 7.0")])
def test_nacelles_are_told_clockwise(wind, told):
    plan = plan_yaw(FARM, Wind.from_met(8.0, wind), method="algorithm-1").found()
    turned = tuple(
        replace(point, nacelle=radians((wind - angle) % 360.0), misalignment=radians(angle))
        for point, angle in zip(plan.set_points, (-5.0, 5.0), strict=True)
    )
    assert facing(plan) == f"{wind:.1f}"
    assert facing(replace(plan, set_points=turned)) == told
