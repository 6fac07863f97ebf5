"""The paper's routing example on coordinates fitted to it, and on those of the real Walney.

The paper names seven turbines, two of which are stations, and gives two plans and their times, but
no coordinates. With those of Walney, whose turbines are so called, its plans take other times and
longer than a battery lasts. The coordinates here were fitted so that both rows of its table come
out under its speed rule, in its wind and with its battery, and so that its two methods find them:
each turbine is nearest to the station that serves it without reassignment, and E105 alone lies
outside the flying range of that station. Many coordinates do; these are a reconstruction.
"""

from collections.abc import Callable
from functools import partial

from windopt.comparison import Method, Routes, as_method
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.routing import RoutingInstance
from windopt.domain.turbine import Turbine
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.heuristics.baseline import baseline
from windopt.heuristics.splitting import split_by_rule
from windopt.io.built_in import built_in_farm
from windopt.planning.routing_methods import OwnMethod
from windopt.result import Result

Heuristic = Callable[..., Result[Routes]]

STATIONS = "B110", "A213"
FITTED = {
    "B110": (0.0, 0.0),
    "A213": (2669.99, 1119.44),
    "C214": (-3599.49, 562.47),
    "A106": (-142.22, -791.45),
    "E105": (3263.32, -4331.87),
    "A411": (669.33, -1076.72),
    "D101": (2668.61, -2425.71),
}
"""Easting and northing from B110 [m]."""

FLYING_RANGE = (16.0 + 10.0) * 1080.0 / 2
"""Radius of the paper's circles that ends upwind where half a flight does [m]."""


def walney() -> dict[str, tuple[float, float]]:
    """Return where the seven turbines of these names stand in Walney [m]."""
    farm = built_in_farm()
    places = dict(zip(farm.names, farm.xy.tolist(), strict=True))
    return {name: (places[name][0], places[name][1]) for name in FITTED}


def _by_rule(heuristic: Heuristic) -> Method:
    """Return a heuristic that cuts tours as the paper does: fly on while the battery lasts."""

    def plan(instance: RoutingInstance, *, time_limit: float, seed: int) -> Result[Routes]:
        return heuristic(instance, split=split_by_rule, time_limit=time_limit, seed=seed)

    return plan


COORDINATES = {"reconstructed": lambda: FITTED, "walney": walney}
"""Coordinates by the name of their table."""


def example(places: dict[str, tuple[float, float]]) -> tuple[Farm, Fleet]:
    """Return the five turbines and the two stations that stand at turbines."""
    turbines = tuple(Turbine(name, *xy) for name, xy in places.items() if name not in STATIONS)
    return Farm("Example", turbines), Fleet(tuple(Station(n, *places[n]) for n in STATIONS))


PLANNERS: dict[str, str | OwnMethod] = {
    "without reassignment": as_method(_by_rule(baseline)),
    "algorithm-2": as_method(_by_rule(partial(algorithm_2, flying_range=FLYING_RANGE))),
    "exact": "exact",
}
"""The paper's two methods, with its rule for cutting tours, and the proof beside them."""
