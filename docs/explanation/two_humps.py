"""The power of two turbines in a row over the misalignment of the first."""

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm, Turbine, Wind
from windopt.io.turbines import load_turbine_type
from windopt.planning.yaw import problem_of
from windopt.wakes.farm import farm_power

nrel = load_turbine_type("nrel_5MW")
farm = Farm("Two", (Turbine("T1", 0.0, 0.0, nrel), Turbine("T2", 630.0, 0.0, nrel)))
gamma = np.radians(np.linspace(-30.0, 30.0, 241))

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
for direction in 270.0, 272.0, 275.0:
    faced = windopt.plan_yaw(farm, Wind.from_met(8.0, direction), method="algorithm-1").found()
    powers = farm_power(problem_of(faced), np.c_[gamma, np.zeros_like(gamma)])
    ax.plot(np.degrees(gamma), powers / 1e6, label=f"wind from {direction:.0f}°")
ax.set(xlabel="misalignment of the first turbine (°)", ylabel="power of both (MW)")
ax.legend()
