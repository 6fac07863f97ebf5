"""The longest flight of a plan, made of two labels and the leg between them."""

import matplotlib.pyplot as plt
import numpy as np

import windopt
from windopt import Farm, Wind
from windopt.io.built_in import built_in_stations

farm, fleet = Farm.load("Walney"), built_in_stations()
plan = windopt.plan_inspection(farm, fleet, Wind.from_met(10.0, 90.0), time_limit=5.0).found()
flight = max(plan.flights, key=lambda flight: flight.duration)
station = next(station for station in fleet.stations if station.name == flight.station)
visited = [farm.names.index(name) for name in flight.turbines]
way = np.array([(station.x, station.y), *farm.xy[visited], (station.x, station.y)]) / 1000
arrival = np.cumsum(flight.legs)
joined = int(np.searchsorted(arrival, station.uav.t_max / 2))  # the leg on which half goes by

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
ax.plot(*farm.xy.T / 1000, ".", color="0.75")
for part, label in (
    (way[: joined + 1], "from the station, up to half of t_max"),
    (way[joined + 1 :][::-1], "from the end, backwards"),
):
    ax.plot(*part.T, ".-", label=label)
ax.plot(*way[joined : joined + 2].T, "k--", label="the leg that joins them")
ax.plot(*way[0], "k^", label=f"station {station.name}")
(west, south), (east, north) = way.min(axis=0) - 0.5, way.max(axis=0) + 0.5
ax.set(xlim=(west, east), ylim=(south, north), xlabel="easting (km)", ylabel="northing (km)")
ax.set_aspect("equal")
figure.legend(loc="outside right center")
