"""Serial refine against FLORIS's own, where it is installed, and against trying everything."""

from itertools import product

import numpy as np
import pytest

from windopt.heuristics.serial_refine import serial_refine
from windopt.result import Status
from windopt.wakes.farm import farm_power


def test_a_rotor_with_another_behind_it_turns_to_the_best_of_both_passes(steered, row):
    problem = steered(row(2), direction=272.0)
    result = serial_refine(problem)
    coarse = np.radians([-25.0, -12.5, 0.0, 12.5, 25.0])
    a = coarse[np.argmax([farm_power(problem, np.array([g, 0.0])) for g in coarse])]
    fine = a + np.radians([-6.25, -3.125, 0.0, 3.125, 6.25])
    grid = [np.clip(pair, problem.lower, problem.upper) for pair in product(fine, [0.0])]
    assert result.objective == pytest.approx(max(farm_power(problem, g) for g in grid))
    assert result.status is Status.FEASIBLE
    assert result.objective <= result.bound


def test_it_never_does_worse_than_facing_the_wind(steered, scattered):
    problem = steered(scattered(9), direction=[100.0, 105.0], unlike=True)
    assert serial_refine(problem).objective >= farm_power(problem, np.zeros(9))


def test_ctrl_c_keeps_the_rotors_turned_so_far(steered, row, monkeypatch):
    def stopped_after_one(sweep, *, deadline):
        sweep.turn(0, 0.3)
        raise KeyboardInterrupt

    monkeypatch.setattr("windopt.heuristics.serial_refine.refine", stopped_after_one)
    result = serial_refine(steered(row(3), direction=272.0))
    assert result.status is Status.INTERRUPTED
    assert result.found() == pytest.approx([0.3, 0.0, 0.0])


def test_ctrl_c_while_the_wakes_compile_leaves_the_rotors_facing_the_wind(
    steered, row, monkeypatch
):
    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("windopt.heuristics.serial_refine.Sweep", stopped)
    problem = steered(row(3), direction=272.0)
    result = serial_refine(problem)
    assert result.status is Status.INTERRUPTED
    assert (result.found() == 0).all()
    assert result.objective == pytest.approx(float(farm_power(problem, np.zeros(3))))


@pytest.mark.parametrize("direction", [272.0, 275.0])
def test_it_finds_what_floris_finds(steered, direction):
    floris = pytest.importorskip("floris")
    from floris.optimization.yaw_optimization.yaw_optimizer_sr import YawOptimizationSR

    problem = steered([(5.0 * i, 3.0 * j) for i in range(2) for j in range(2)], direction=direction)
    settings = floris.FlorisModel.get_defaults()
    for part in "secondary_steering", "yaw_added_recovery", "transverse_velocities":
        settings["wake"][f"enable_{part}"] = False
    x, y = problem.turbines.T
    turbine = turbine_of(problem)
    settings["farm"] |= {"layout_x": list(x), "layout_y": list(y), "turbine_type": [turbine]}
    model = floris.FlorisModel(settings)
    model.set(wind_speeds=[8.0], wind_directions=[direction], turbulence_intensities=[0.06])
    theirs = YawOptimizationSR(model, minimum_yaw_angle=-25.0, maximum_yaw_angle=25.0)
    found = theirs.optimize(print_progress=False)
    ours = serial_refine(problem)
    assert ours.objective == pytest.approx(found.farm_power_opt[0], rel=1e-12)
    assert np.degrees(ours.found()) == pytest.approx(found.yaw_angles_opt[0], abs=1e-9)


def turbine_of(problem):
    """Return the turbine as FLORIS defines one."""
    curve = problem.curves[0]
    return {
        "turbine_type": "of the tests",
        "hub_height": float(problem.hub_heights[0]),
        "rotor_diameter": float(problem.rotor_diameters[0]),
        "TSR": 8.0,
        "operation_model": "cosine-loss",
        "power_thrust_table": {
            "ref_air_density": curve.air_density,
            "ref_tilt": 0.0,
            "cosine_loss_exponent_tilt": 1.88,
            "cosine_loss_exponent_yaw": curve.yaw_exponent,
            "wind_speed": list(curve.wind_speeds),
            "power": [p / 1e3 for p in curve.powers],
            "thrust_coefficient": list(curve.thrust_coefficients),
        },
    }
