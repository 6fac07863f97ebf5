"""
A formulation of your own, compared
===================================

A formulation is a function from flight times to a program, so a variant of one is a few lines.
This tutorial adds rows to the formulation with the flight time as a flow, sees what they do to its
linear relaxation, and compares it with others on a real farm.
"""  # noqa: D205, D400

# %%
# An instance
# -----------
# Albatros has 16 turbines. Its stations are placed by the exact cover, and the wind is the paper's.

import matplotlib.pyplot as plt

import windopt
from formulations.time_flow import time_flow
from windopt import Farm, Wind
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.planning.reach import routing_instance
from windopt.planning.stations import stations_by_cover

farm = Farm.load("Albatros")
fleet = stations_by_cover(farm).found()
instance = routing_instance(farm, fleet, Wind.from_met(10, 90), dwell=[0.0] * len(farm))
print(len(fleet), "station; times in an array of shape", instance.t.shape)

# %%
# Ten lines
# ---------
# No flight goes from turbine i to turbine j and straight back, but half of each way is cheap in a
# linear relaxation. :doc:`/formulations/time_flow` adds such rows only where a solution breaks
# them; here they stand in the program from the start.


def without_returns(t, t_max, *, allowed=None):
    """Add a row for each pair of turbines: at most one of the two ways between them is flown."""
    program = time_flow(t, t_max, allowed=allowed)
    x, flown = program.x, program.arcs.flown.any(axis=0)
    n = len(flown)
    for i in range(1, n):
        for j in range(i + 1, n):
            if flown[i, j] and flown[j, i]:
                program.model.addConstr(x[:, i, j].sum() + x[:, j, i].sum() <= 1)
    return program


# %%
# What the rows do to the relaxation
# ----------------------------------
# :func:`windopt.relax` solves the linear relaxation of a program as it is stated. The higher, the
# less is left to branching.

for formulation in time_flow, without_returns:
    relaxed = windopt.relax(formulation(instance.t, instance.t_max))
    print(f"{formulation.__name__:16} {relaxed.bound:8.1f} s")

# %%
# Side by side
# ------------
# :func:`windopt.compare` runs formulations and methods under one limit and adds up every answer
# anew. Its table prints, and ``table.frame()`` is a pandas ``DataFrame``.

methods = {"time-flow": time_flow, "mine": without_returns, "algorithm-2": algorithm_2}
table = windopt.compare(methods, {"Albatros": instance}, time_limit=20)
print(table)

# %%
# Each result carries its trace: objective and bound whenever one of them improved.

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
for colour, row in zip(("C0", "C1"), table.rows, strict=False):
    time, objective, bound = zip(*row.result.trace, strict=True)
    ax.step(time, objective, colour, where="post", label=f"{row.method}: plan")
    ax.step(time, bound, f"{colour}--", where="post", label=f"{row.method}: bound")
ax.set(xlabel="time [s]", ylabel="total flight time [s]", ylim=(0, None))
ax.legend()

# %%
# To run it on all farms, :doc:`/how_to/benchmark`.
