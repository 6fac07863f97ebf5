"""What the best misalignments of one direction, and those robust to a spread, gain around it."""

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm, Steering, Turbine, Wind
from windopt.io.turbines import load_turbine_type
from windopt.planning.yaw import problem_of
from windopt.wakes.farm import turbine_powers

nrel = load_turbine_type("nrel_5MW")
places = [(630.0 * i, 630.0 * j) for j in range(5) for i in range(5)]
farm = Farm("5 x 5", tuple(Turbine(f"T{k}", x, y, nrel) for k, (x, y) in enumerate(places)))
wind = Wind.from_met(8.0, 270.0)

offsets = np.arange(-10.0, 10.25, 0.5)
around = [(Wind.from_met(8.0, 270.0 + offset), 1 / len(offsets)) for offset in offsets]
exposed = windopt.plan_yaw(
    farm, wind, method="algorithm-1", steering=Steering(scenarios=tuple(around))
)
problem = problem_of(exposed.found())

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
facing = turbine_powers(problem, np.zeros(25)).sum(axis=-1)
for label, std in (("best in 270° exactly", 0.0), ("robust to a spread of 5°", 5.0)):
    steering = Steering(direction_std=np.radians(std))
    plan = windopt.plan_yaw(farm, wind, steering=steering).found()
    gamma = np.array([point.misalignment for point in plan.set_points])
    gain = turbine_powers(problem, gamma).sum(axis=-1) / facing - 1
    ax.plot(270.0 + offsets, 100 * gain, label=label)
ax.axhline(0.0, color="0.6", lw=0.8)
ax.set(xlabel="wind direction (°)", ylabel="power gained over facing the wind (%)")
ax.legend()
