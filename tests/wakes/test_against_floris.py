"""The twin against FLORIS itself, where it is installed."""

from math import pi

import numpy as np
import pytest

from windopt.domain.power_curve import PowerCurve
from windopt.domain.yaw_problem import YawProblem
from windopt.wakes.farm import flow

floris = pytest.importorskip("floris")


def model(x, y, types):
    """FLORIS with its ``gauss`` wake and without the curl's additions."""
    settings = floris.FlorisModel.get_defaults()
    for part in "secondary_steering", "yaw_added_recovery", "transverse_velocities":
        settings["wake"][f"enable_{part}"] = False
    settings["flow_field"]["reference_wind_height"] = 90.0
    settings["farm"] |= {"layout_x": list(x), "layout_y": list(y), "turbine_type": types}
    return floris.FlorisModel(settings)


def curves(fmodel):
    tables = [t["power_thrust_table"] for t in fmodel.core.farm.turbine_definitions]
    return [
        PowerCurve(
            tuple(map(float, table["wind_speed"])),
            tuple(1e3 * float(p) for p in table["power"]),
            tuple(map(float, table["thrust_coefficient"])),
            table["ref_air_density"],
            table["cosine_loss_exponent_yaw"],
        )
        for table in tables
    ]


def random_case(seed):
    """Return FLORIS's model, the problem it solves and random misalignments [rad]."""
    rng = np.random.default_rng(seed)
    n, S = int(rng.integers(2, 12)), 3
    x, y = rng.uniform(0, 250 * n, (2, n))
    types = list(rng.choice(["nrel_5MW", "iea_10MW", "iea_15MW"], n))
    fmodel = model(x, y, types)
    speeds, directions = rng.uniform(4, 16, S), rng.uniform(0, 360, S)
    turbulence = rng.uniform(0.03, 0.15)
    fmodel.set(
        wind_speeds=speeds,
        wind_directions=directions,
        turbulence_intensities=np.full(S, turbulence),
        air_density=1.1,
    )
    distinct = tuple(dict.fromkeys(curves(fmodel)))
    farm = fmodel.core.farm
    problem = YawProblem(
        np.c_[x, y],
        distinct,
        np.array([distinct.index(curve) for curve in curves(fmodel)]),
        np.ravel(
            farm.rotor_diameters[0] if farm.rotor_diameters.ndim > 1 else farm.rotor_diameters
        ),
        np.array([t["hub_height"] for t in farm.turbine_definitions]),
        speeds,
        np.radians(directions),
        np.full(S, 1 / S),
        turbulence,
        np.full(n, -pi / 6),
        np.full(n, pi / 6),
        air_density=1.1,
        reference_height=90.0,
    )
    return fmodel, problem, rng.uniform(-pi / 6, pi / 6, n)


@pytest.mark.parametrize("seed", range(8))
def test_every_turbine_delivers_what_floris_says(seed):
    fmodel, problem, gamma = random_case(seed)
    fmodel.set(yaw_angles=np.tile(np.degrees(gamma), (3, 1)))
    fmodel.run()
    ours = flow(problem, gamma)
    theirs = fmodel.get_turbine_powers()
    assert ours.powers.sum(axis=1) == pytest.approx(theirs.sum(axis=1), rel=1e-9)
    assert ours.powers == pytest.approx(theirs, rel=1e-7, abs=1e-3)
    assert ours.turbulence == pytest.approx(fmodel.get_turbine_TIs(), rel=1e-9)
