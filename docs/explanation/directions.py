"""The two angles of a wind: where it comes from, and where it blows to."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc

from windopt import Wind

wind = Wind.from_met(speed=1.0, direction=60.0)
met, pol = np.degrees(wind.theta_met), np.degrees(wind.theta_pol)

figure, ax = plt.subplots(figsize=(4.5, 4.5), layout="constrained")
ax.annotate("", (wind.u, wind.v), (-wind.u, -wind.v), arrowprops={"arrowstyle": "-|>", "lw": 2})
ax.text(-wind.u, -wind.v + 0.08, "wind", ha="center")
ax.add_patch(Arc((0, 0), 0.9, 0.9, theta1=90 - met, theta2=90, color="C0", lw=2))
ax.add_patch(Arc((0, 0), 0.6, 0.6, theta1=0, theta2=pol, color="C1", lw=2))
ax.text(0.18, 0.52, rf"$\theta^{{met}} = {met:.0f}°$", color="C0")
ax.text(-0.8, 0.3, rf"$\theta^{{pol}} = {pol:.0f}°$", color="C1")
for label, (x, y) in {"N": (0, 1), "E": (1, 0), "S": (0, -1), "W": (-1, 0)}.items():
    ax.plot([0, x], [0, y], color="0.75", lw=0.8, zorder=0)
    ax.text(1.1 * x, 1.1 * y, label, ha="center", va="center", color="0.4")
ax.set(xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), aspect="equal")
ax.axis("off")
