"""
Train, quantise and deploy a forecaster
=======================================

A forecaster learns from measurements on a large machine and runs on a small one. This tutorial goes
that way with the month of wind that comes with windopt: training with torch, weights on sixteen
levels, a file of a few kilobytes, and forecasts with NumPy alone. Where these pages were built
without torch, the code below has not run and shows no output.
"""  # noqa: D205, D400

# %%
# The measurements
# ----------------
# The last third tests the forecaster and must not train it. A split in time keeps both apart: no
# window of the one shares a value with a window of the other.

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt
import numpy as np

from windopt.forecasting.evaluation import evaluate
from windopt.forecasting.lstm import EdgeForecaster, WindForecaster
from windopt.forecasting.report import report
from windopt.forecasting.training.fit import Recipe
from windopt.forecasting.training.loop import Schedule
from windopt.forecasting.windows import chronological_split
from windopt.io.built_in import built_in_series
from windopt.plotting import plot_forecast

series = built_in_series()
before, after = chronological_split(series, test=1 / 3)
print(len(before), "rows to learn from,", len(after), "to test on")

# %%
# Training
# --------
# The recipe says what to train. A month is little to learn from, so the network is small and sees
# the month many times: first in floating point, then with its weights on the levels of 4 bits, so
# that it learns to live with them. ``progress`` is called after each pass.

recipe = Recipe(
    units=32,
    bits=4,
    stride=1,
    schedule=Schedule(epochs=16, batch=64),
    refinement=Schedule(epochs=8, batch=64, rate=1.5e-3),
)
passes = []
forecaster = WindForecaster(recipe, seed=0, progress=passes.append).fit(before)

figure, ax = plt.subplots(figsize=(9, 3.5), layout="constrained")
ax.plot([one.loss for one in passes], label="training")
ax.plot([one.validation_loss for one in passes], label="validation")
ax.axvline(recipe.schedule.epochs - 0.5, color="grey", linestyle=":", label="onto the levels")
ax.set(xlabel="pass over the windows", ylabel="loss")
ax.legend()

# %%
# Is it any good?
# ---------------
# Persistence, the forecast that nothing changes, is what a forecaster must beat. Errors are means
# over the next 40 minutes.


def show(forecaster):
    """Print the errors of a forecaster beside those of the baselines."""
    for method in report(evaluate([forecaster], series, test=1 / 3))["methods"]:
        speed, direction = method["speed_mae"], method["direction_mae"]
        print(f"{method['name']:24s} {speed:.3f} m/s  {direction:.2f} deg")


show(forecaster)

# %%
# Sixteen levels
# --------------
# Each of the nine matrices has a scale of its own, and its weights are one of sixteen multiples of
# it. That is all the file keeps: two weights in a byte.

gate = forecaster.model.weights.U[1]
figure, ax = plt.subplots(figsize=(9, 3), layout="constrained")
levels, counts = np.unique(gate.values, return_counts=True)
ax.bar(levels, counts, width=0.8 * np.diff(levels).min())
ax.set(xlabel="weight [-]", ylabel="count", title="the forget gate's weights of the state")
print(len(levels), "of 16 levels taken")

# %%
# Into a file
# -----------
# The same network in floating point takes several times the room. The smaller the network, the
# less is to be won: biases and scaling stay as they are.

folder = Path(mkdtemp())
forecaster.save(folder / "4-bits.npz")
floats = WindForecaster(Recipe(**{**vars(recipe), "bits": 32}), seed=0).fit(before)
floats.save(folder / "32-bits.npz")
for path in sorted(folder.iterdir()):
    print(path.name, path.stat().st_size, "bytes")
show(floats)

# %%
# On the small machine
# --------------------
# The file needs no torch. In integer arithmetic its forecasts are the same to the last bit on every
# machine; they differ a little from those in floating point.

small = EdgeForecaster.load(folder / "4-bits.npz", arithmetic="integer")
known = series.until(np.datetime64("2009-01-28T06:00"))
forecast = small.predict(known)
print(forecast.speed.round(2), "m/s in integers")
print(forecaster.predict(known).speed.round(2), "m/s in floats")

figure, ax = plt.subplots(figsize=(9, 4), layout="constrained")
plot_forecast(series, forecast, ax)

# %%
# What may come
# -------------
# Quantiles say how sure the forecast is, and scenarios are coherent winds drawn from them.

rng = np.random.default_rng(0)
minutes = 10 * np.arange(1, len(forecast) + 1)
figure, ax = plt.subplots(figsize=(9, 4), layout="constrained")
for path in forecast.scenarios(30, rng):
    ax.plot(minutes, path.speed, color="C0", alpha=0.3, linewidth=1)
ax.fill_between(
    minutes,
    forecast.quantiles.speed[:, 0],
    forecast.quantiles.speed[:, -1],
    color="C1",
    alpha=0.3,
    label="90 % of the winds",
)
ax.plot(minutes, forecast.speed, color="C1", label="forecast")
ax.set(xlabel="minutes ahead", ylabel="wind speed [m/s]")
ax.legend()

# %%
# :func:`windopt.plan` takes the file as its forecaster,
# ``windopt.plan(farm, fleet, series, forecaster="4-bits.npz")``, and so does
# ``windopt plan FARM --wind FILE --forecaster 4-bits.npz``.
