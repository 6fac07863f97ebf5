"""The routing methods by name, exact and heuristic, with one signature.

The formulations begin with Algorithm 2's plan, so that a limit never leaves them with nothing.
"""

from collections.abc import Callable
from typing import Protocol

from windopt.domain.routing import Route, RoutingInstance
from windopt.heuristics.algorithm_2 import algorithm_2
from windopt.heuristics.baseline import baseline
from windopt.result import Result

Progress = Callable[[float, float], None]
Routes = tuple[Route, ...]


class RoutingMethod(Protocol):
    """A way to plan flights."""

    def __call__(
        self,
        instance: RoutingInstance,
        *,
        gap: float,
        time_limit: float,
        seed: int,
        progress: Progress | None,
    ) -> Result[Routes]:
        """Return routes that visit every turbine of ``instance`` once."""


def _heuristic(method: Callable[..., Result[Routes]]) -> RoutingMethod:
    """Return a heuristic as a routing method; a gap means nothing to it."""

    def solve(
        instance: RoutingInstance,
        *,
        gap: float,
        time_limit: float,
        seed: int,
        progress: Progress | None,
    ) -> Result[Routes]:
        result = method(instance, time_limit=time_limit, seed=seed)
        if progress is not None:
            progress(result.objective, result.bound)
        return result

    return solve


METHODS: dict[str, RoutingMethod] = {
    "algorithm-2": _heuristic(algorithm_2),
    "baseline": _heuristic(baseline),
}
"""Routing methods by name."""
