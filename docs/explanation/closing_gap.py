"""Plan and bound over the time of a search."""

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm, Status, Wind
from windopt.io.built_in import built_in_stations

farm, fleet = Farm("Walney 1", Farm.load("Walney").turbines[:51]), built_in_stations()
for _ in range(2):  # the first search on a machine compiles
    search = windopt.plan_inspection(farm, fleet, Wind.from_met(10.0, 90.0), time_limit=300.0)
assert search.status is Status.OPTIMAL, "The text tells that plan and bound meet."
time, plan, bound = np.array(search.trace).T

figure, (ax, near) = plt.subplots(1, 2, figsize=(8, 3.5), layout="constrained")
for axes in ax, near:
    axes.step(time, plan / 60, where="post", label="best plan")
    axes.step(time, bound / 60, where="post", label="bound")
    axes.set(xlabel="time of the search (s)", ylabel="time of all flights (min)")
near.set_ylim(0.98 * plan[-1] / 60, 1.02 * plan[-1] / 60)
near.set_title("the last 2 %")
ax.legend()
