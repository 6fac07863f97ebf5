"""One matrix per route against enumeration, and against the flight-time flow."""

import numpy as np
import pytest

from formulations.route_indexed import route_indexed
from formulations.time_flow import time_flow
from windopt.result import Status
from windopt.solving.integer import solve


@pytest.mark.slow
@pytest.mark.parametrize(("times", "n", "k"), [("wind", 7, 3), ("paper", 5, 2), ("any", 5, 2)])
@pytest.mark.parametrize("hundred", range(5))
def test_optimum_equals_enumeration_on_a_hundred_random_instances(hundred, times, n, k, routing):
    for seed in range(100 * hundred, 100 * hundred + 100):
        t, t_max, allowed = routing.instances[times](seed, turbines=n, stations=k)
        expected = routing.cheapest(t, t_max, allowed)
        result = solve(route_indexed(t, t_max, allowed=allowed))
        # Sums of at most 10 legs in another order: 1e-9 is generous.
        assert result.objective == pytest.approx(expected, rel=1e-9), seed
        assert (result.status is Status.INFEASIBLE) == np.isinf(expected), seed


@pytest.mark.parametrize("seed", range(3))
def test_seven_turbines_and_three_stations_equal_enumeration(seed, routing):
    rng = np.random.default_rng(seed)
    t = routing.flight_times(
        rng.uniform(0, 5000, (3, 2)), rng.uniform(0, 5000, (7, 2)), rng.uniform(-8, 8, 2)
    )
    result = solve(route_indexed(t, 1200.0, routes=2))
    assert result.objective == pytest.approx(routing.cheapest(t, 1200.0), rel=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_eight_turbines_and_two_routes_are_proved(seed, routing):
    rng = np.random.default_rng(seed)
    t = routing.flight_times(
        rng.uniform(0, 6000, (1, 2)), rng.uniform(0, 6000, (8, 2)), [0.0, -10.0]
    )
    t_max = 1.5 * (t[:, 0, 1:] + t[:, 1:, 0]).max()
    program = route_indexed(t, t_max, routes=2)
    result = solve(program)
    assert result.status is Status.OPTIMAL
    assert len(program.routes(result.solution)) <= 2
    assert result.objective == pytest.approx(solve(time_flow(t, t_max)).objective, rel=1e-9)


def test_too_few_routes_are_infeasible():
    t = np.full((4, 4), 100.0)
    assert solve(route_indexed(t, 200.0, routes=2)).status is Status.INFEASIBLE
    assert solve(route_indexed(t, 200.0, routes=3)).objective == pytest.approx(600.0)


def test_a_route_may_stay_on_the_ground():
    t = np.full((4, 4), 100.0)
    program = route_indexed(t, 400.0)
    result = solve(program)
    assert result.objective == pytest.approx(400.0)
    assert len(program.routes(result.solution)) == 1


def test_no_route_is_not_a_number_of_routes():
    with pytest.raises(ValueError, match="routes >= 1"):
        route_indexed(np.ones((3, 3)), 10.0, routes=0)
