"""
From a wind file to yaw set-points and checked flights
======================================================

Measurements of the wind go in; yaw set-points for the turbines and inspection flights for UAVs
come out. This tutorial goes that way once, with the farm and the wind series that come with
windopt, so that it needs no network.
"""  # noqa: D205, D400

# %%
# A farm and its wind
# -------------------
# Walney stands in the Irish Sea: Walney 1, Walney 2 and Walney Extension, 189 turbines.

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm
from windopt.io.built_in import built_in_series, built_in_stations
from windopt.plotting import plot_flights, plot_forecast, plot_yaw

farm = Farm.load("Walney")
series = built_in_series()
print(len(farm), "turbines")
print(len(series), "rows, one every", series.step_seconds / 60, "minutes, from", series.time[0])

# %%
# :class:`windopt.WindSeries` says where a series comes from, and its reader what it found.

print(series.source)
print(series.notes)

# %%
# Stations for the UAVs
# ---------------------
# UAVs fly from stations and must be back before the battery is empty. Walney's come with it;
# :doc:`/how_to/own_farm` shows how to name your own, or to have them placed.

fleet = built_in_stations()
print(len(fleet), "stations, each with", fleet.stations[0].uav)

# %%
# The plan
# --------
# One call forecasts the wind of the next 40 minutes, finds yaw set-points for each step of the
# forecast and plans flights for its mean wind. What was measured after ``time`` is not used.

time = np.datetime64("2009-01-10T14:00")
plan = windopt.plan(farm, fleet, series, time=time, method="algorithm-2")
flights = plan.inspection.found()

figure, ax = plt.subplots(figsize=(9, 5.5), layout="constrained")
plot_flights(flights, ax)

# %%
# Every flight starts and ends at its station. What the method could prove is written beside the
# answer: no plan takes less time than the bound.

print(plan.inspection.status.sentence)
print(
    f"{plan.inspection.objective:.0f} s in the air, at least {plan.inspection.bound:.0f} s needed"
)
print(f"gap {plan.inspection.gap:.1%}, bound by {plan.inspection.bound_source}")
print(flights.flights[0])

# %%
# A turbine out of reach would be listed with the reason, and the rest planned. Here there is none.

print(flights.unreachable)

# %%
# The forecast it was made for
# ----------------------------

figure, ax = plt.subplots(figsize=(9, 4), layout="constrained")
plot_forecast(series, plan.forecast, ax)

# %%
# The set-points
# --------------
# There is one yaw plan for each step of the forecast; this is the first.

yaw = plan.yaw[0].found()
print(f"{yaw.power / 1e6:.1f} MW, facing the wind {yaw.power_baseline / 1e6:.1f} MW")
print(yaw.set_points[0])

figure, ax = plt.subplots(figsize=(9, 5.5), layout="constrained")
plot_yaw(yaw, ax)

# %%
# The check
# ---------
# An independent checker recomputes every flight and every set-point from the farm, the fleet and
# the wind. It shares no code with the methods that made the plan.

report = windopt.check(plan)
print(report.flights, "flights and", report.set_points, "set-points recomputed")
print("passed" if report.passed else report.violations)
