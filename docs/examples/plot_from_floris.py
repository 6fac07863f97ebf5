"""
From FLORIS to windopt
======================

Whoever steers farms with FLORIS can take the same farm here and find the same numbers. The farm is
three NREL 5 MW turbines in a row, five rotor diameters apart, in a wind two degrees off the row.
"""  # noqa: D205, D400

# %%
# In FLORIS
# ---------
# FLORIS's default input is its Gauss-curl hybrid. windopt's model is the Gaussian one, so its three
# additions are switched off:
#
# .. code-block:: python
#
#    from floris import FlorisModel
#    from floris.optimization.yaw_optimization.yaw_optimizer_sr import YawOptimizationSR
#
#    settings = FlorisModel.get_defaults()
#    for part in ("secondary_steering", "yaw_added_recovery", "transverse_velocities"):
#        settings["wake"][f"enable_{part}"] = False
#    settings["farm"]["layout_x"] = [0.0, 630.0, 1260.0]
#    settings["farm"]["layout_y"] = [0.0, 0.0, 0.0]
#    fmodel = FlorisModel(settings)
#    fmodel.set(wind_directions=[272.0], wind_speeds=[8.0], turbulence_intensities=[0.06])
#    table = YawOptimizationSR(fmodel, minimum_yaw_angle=-25.0, maximum_yaw_angle=25.0).optimize()
#
# FLORIS 4.7 then holds, in watts and degrees:
#
# .. code-block:: text
#
#    farm_power_baseline    2892997.048441
#    farm_power_opt         3516455.392028
#    yaw_angles_opt         [25.0, 25.0, 0.0]
#
# In windopt
# ----------
# A FLORIS input file is read as it is: layout and turbines, from FLORIS's library or defined in the
# file. ``windopt yaw gch.yaml --wind-speed 8 --wind-direction 272`` does the following.

from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm, Steering, Wind
from windopt.plotting import plot_facing_wakes, plot_wakes

GCH = """
name: three in a row
floris_version: v4
farm:
  layout_x: [0.0, 630.0, 1260.0]
  layout_y: [0.0, 0.0, 0.0]
  turbine_type: [nrel_5MW]
"""
with TemporaryDirectory() as folder:
    path = Path(folder, "gch.yaml")
    path.write_text(GCH, encoding="utf-8")
    farm = Farm.load(path)

wind = Wind.from_met(speed=8.0, direction=272.0)
result = windopt.plan_yaw(farm, wind, steering=Steering(turbulence=0.06))
plan = result.found()
print(f"facing the wind {plan.power_baseline:.6f} W")
print(f"steered         {plan.power:.6f} W, {plan.gain:+.2%}")
print("misalignments  ", np.degrees([point.misalignment for point in plan.set_points]).round(2))

# %%
# The misalignments are FLORIS's yaw angles, sign and all, and may be given to ``fmodel.set`` as
# they are. What FLORIS does not say is how far the best may be away: no misalignments deliver more
# than all turbines would without wakes.

print(result.status.sentence)
print(f"at most {result.bound / 1e6:.3f} MW: {result.bound_source}")

# %%
# Before and after
# ----------------

figure, (before, after) = plt.subplots(2, 1, figsize=(9, 7), layout="constrained")
plot_facing_wakes(plan, before)
plot_wakes(plan, after)

# %%
# What else is the same
# ---------------------
# ``--bounds``, ``--turbulence`` and ``--direction-std`` stand for ``minimum_yaw_angle``,
# ``maximum_yaw_angle``, ``turbulence_intensities`` and FLORIS's ``UncertainFlorisModel``;
# ``--method serial-refine`` is FLORIS's own search. ``windopt yaw-table`` writes its columns.
# New are a cap on the farm's power, ``--farm-cap``, and a check that recomputes everything:

report = windopt.check(result)
print("passed" if report.passed else report.violations)
