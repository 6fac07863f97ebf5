"""
Where to put the UAVs
=====================

Stations for the built-in farm Walney: the fewest that reach every turbine, and k-means beside them.
"""  # noqa: D205, D400

# %%
# The fewest stations
# -------------------
# A turbine is within reach of a station if a UAV inspects it and is back with 5 % of its longest
# flight left, in 10 m/s of wind from anywhere. The number is proven, for the candidate sites.

import matplotlib.pyplot as plt

from windopt import Farm
from windopt.planning.station_design import station_design
from windopt.planning.stations import stations_by_cover, stations_by_k_means
from windopt.plotting import plot_farm

farm = Farm.load("Walney")
result = stations_by_cover(farm)
exact = result.found()
print(len(exact), "stations,", result.status, "with bound", result.bound)
print(result.bound_source)

# %%
# k-means beside it
# -----------------
# The paper places UAVs by k-means. Clusters are compact, which is not what reach asks for, so it
# takes as many or more.

by_k_means = stations_by_k_means(farm, margin=0.05)
print(len(by_k_means), "stations by k-means")

design = station_design(farm)
for name, fleet in ("cover", exact), ("k-means", by_k_means):
    print(f"{name}: {len(fleet)} stations, {design.total_time(fleet) / 60:.0f} min of round trips")

# %%
# More stations shorten the round trips; the exact choice of as many as k-means needs is quicker.

as_many = stations_by_cover(farm, len(by_k_means))
print(f"{as_many.objective / 60:.0f} min, {as_many.status}")

# %%
# On the map
# ----------
# Around each station of the cover, the circle it reaches even against the wind.

figure, ax = plt.subplots(figsize=(9, 6), layout="constrained")
plot_farm(farm, ax)
for name, fleet, marker in ("cover", exact, "s"), ("k-means", by_k_means, "x"):
    x, y = zip(*((station.x / 1e3, station.y / 1e3) for station in fleet.stations), strict=True)
    ax.plot(x, y, marker, color="C3" if marker == "s" else "C0", label=name, zorder=3)
for station in exact.stations:
    centre = station.x / 1e3, station.y / 1e3
    ax.add_patch(plt.Circle(centre, design.radius / 1e3, fill=False, color="C3", lw=0.6))
ax.legend()
