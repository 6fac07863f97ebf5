r"""The power coefficient, written anew from the published constants.

.. math::

    C_p = c_1 (c_2 / \lambda_i - c_3 \beta - c_4 \beta^x - c_5)\, e^{-c_6 / \lambda_i}
          + c_7 \lambda, \qquad
    \frac{1}{\lambda_i} = \frac{1}{\lambda + c_8 \beta} - \frac{c_9}{\beta^3 + 1},

with the pitch :math:`\beta` in degrees.
"""

from collections.abc import Iterator
from functools import cache
from itertools import product
from math import exp

TIP_SPEED_RATIO = (1.0, 15.0)
"""Tip-speed ratios for which the models hold [-]; near 0 they have poles."""

PITCH = (0.0, 30.0)
"""Blade pitches for which the models hold [deg]."""

CONSTANTS = {  # c1, c2, c3, c4, x, c5, c6, c7, c8, c9
    "slootweg": (0.73, 151, 0.58, 0.002, 2.14, 13.2, 18.4, 0.0, -0.02, 0.003),
    "heier": (0.5, 116, 0.4, 0.0, 1.0, 5, 21, 0.0, 0.089, 0.035),
    "mathworks": (0.5176, 116, 0.4, 0.0, 1.0, 5, 21, 0.0068, 0.08, 0.035),
    "dai": (0.22, 120, 0.4, 0.0, 1.0, 5, 12.5, 0.0, 0.08, 0.035),
}
"""Slootweg 2003, Heier, MathWorks' wind turbine block and Dai 2016."""


def power_coefficient(model: str, tip_speed_ratio: float, pitch: float) -> float:
    """Return C_p [-] at a tip-speed ratio [-] and a pitch [deg]."""
    c1, c2, c3, c4, x, c5, c6, c7, c8, c9 = CONSTANTS[model]
    inverse = 1 / (tip_speed_ratio + c8 * pitch) - c9 / (pitch**3 + 1)
    bracket = c2 * inverse - c3 * pitch - c4 * pitch**x - c5
    return float(c1 * bracket * exp(-c6 * inverse) + c7 * tip_speed_ratio)


@cache
def largest_power_coefficient(model: str) -> float:
    """Return the largest C_p [-]: a grid finds the model's one hump, ever shorter steps climb it.

    The rotor does reach the value returned, so that no true maximum is below it.
    """

    def height(place: tuple[float, float]) -> float:
        return power_coefficient(model, *place)

    step = 0.1
    peak = max(product(_grid(*TIP_SPEED_RATIO, step), _grid(*PITCH, 5 * step)), key=height)
    while step > 1e-8:
        higher = max(_around(peak, step), key=height)
        if height(higher) > height(peak):
            peak = higher
        else:
            step /= 2
    return height(peak)


def _grid(low: float, high: float, step: float) -> list[float]:
    return [min(low + i * step, high) for i in range(round((high - low) / step) + 1)]


def _around(place: tuple[float, float], step: float) -> Iterator[tuple[float, float]]:
    """Yield the places one step away inside the box; pitch takes five times the step."""
    for faster, steeper in product((-step, 0.0, step), repeat=2):
        tip_speed_ratio = min(max(place[0] + faster, TIP_SPEED_RATIO[0]), TIP_SPEED_RATIO[1])
        pitch = min(max(place[1] + 5 * steeper, PITCH[0]), PITCH[1])
        yield tip_speed_ratio, pitch
