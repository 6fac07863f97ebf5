"""The flight-time flow against enumeration, against its own symmetries and at its sizes."""

from itertools import pairwise

import numpy as np
import pytest

from formulations.time_flow import time_flow
from windopt.result import Status
from windopt.solving.integer import solve

U_MAX, T_MAX = 16.0, 1080.0  # m/s, s


@pytest.fixture
def farm():
    """Two stations and six turbines in a wind from the north-east, flights of 18 minutes."""
    rng = np.random.default_rng(3)
    return rng.uniform(0, 4000, (2, 2)), rng.uniform(0, 4000, (6, 2)), np.array([-7.0, -6.0])


@pytest.fixture
def optimum(routing):
    def value(stations, turbines, w, t_max=T_MAX, **options):
        result = solve(time_flow(routing.flight_times(stations, turbines, w, **options), t_max))
        assert result.status is Status.OPTIMAL
        return result.objective

    return value


@pytest.mark.slow
@pytest.mark.parametrize("times", ["wind", "paper", "any"])
@pytest.mark.parametrize("hundred", range(5))
def test_optimum_equals_enumeration_on_a_hundred_random_instances(hundred, times, routing):
    for seed in range(100 * hundred, 100 * hundred + 100):
        t, t_max, allowed = routing.instances[times](seed, turbines=7, stations=3)
        expected = routing.cheapest(t, t_max, allowed)
        result = solve(time_flow(t, t_max, allowed=allowed))
        # Sums of at most 14 legs in another order: 1e-9 is generous.
        assert result.objective == pytest.approx(expected, rel=1e-9), seed
        assert (result.status is Status.INFEASIBLE) == np.isinf(expected), seed


@pytest.mark.parametrize("seed", range(2, 12))
def test_flights_are_what_the_objective_says(seed, routing):
    t, t_max, _ = routing.random_instance(seed, turbines=7, stations=3)
    program = time_flow(t, t_max)
    result = solve(program)
    assert result.solution is not None
    routes = program.routes(result.solution)
    legs = [(d, list(pairwise((0, *(i + 1 for i in flight), 0)))) for d, flight in routes]
    durations = [sum(t[d, i, j] for i, j in flight) for d, flight in legs]
    assert sorted(i for _, flight in routes for i in flight) == list(range(t.shape[1] - 1))
    assert all(
        time <= t_max[d] * (1 + 1e-9) for (d, _), time in zip(routes, durations, strict=True)
    )
    assert sum(durations) == pytest.approx(result.objective)


def test_a_lone_turbine_costs_its_round_trip():
    t = np.array([[0.0, 100.0], [250.0, 0.0]])
    program = time_flow(t, 400.0)
    result = solve(program)
    assert result.objective == pytest.approx(350.0)
    assert program.routes(result.solution) == [(0, (0,))]


def test_turbines_in_a_row_are_flown_in_a_row_until_the_battery_forbids_it():
    x = np.arange(4) * 100.0
    t = np.abs(x[:, None] - x)
    assert solve(time_flow(t, 600.0)).objective == pytest.approx(600.0)
    t[:, 1:] += 50.0  # inspection
    assert solve(time_flow(t, 750.0)).objective == pytest.approx(750.0)
    assert solve(time_flow(t, 749.0)).objective == pytest.approx(600.0 + 200.0 + 150.0)


def test_translating_the_farm_changes_nothing(farm, optimum):
    stations, turbines, w = farm
    shift = np.array([3.2e5, 6.1e6])
    assert optimum(stations + shift, turbines + shift, w) == pytest.approx(optimum(*farm))


def test_turning_farm_and_wind_together_changes_nothing(farm, optimum):
    c, s = np.cos(0.7), np.sin(0.7)
    turn = np.array([[c, s], [-s, c]])
    assert optimum(*(part @ turn for part in farm)) == pytest.approx(optimum(*farm))


def test_mirroring_farm_and_wind_together_changes_nothing(farm, optimum):
    assert optimum(*(part * [-1.0, 1.0] for part in farm)) == pytest.approx(optimum(*farm))


def test_lengths_and_speeds_scale_together(farm, optimum):
    scaled = optimum(*(3.0 * part for part in farm), u_max=3.0 * U_MAX)
    assert scaled == pytest.approx(optimum(*farm))


def test_names_of_turbines_and_stations_do_not_matter(farm, optimum):
    stations, turbines, w = farm
    order = np.random.default_rng(0).permutation(len(turbines))
    assert optimum(stations[::-1], turbines[order], w) == pytest.approx(optimum(*farm))


def test_the_opposite_wind_reverses_the_flights(farm, optimum):
    stations, turbines, w = farm
    assert optimum(stations, turbines, -w) == pytest.approx(optimum(*farm))


def test_a_second_station_on_the_same_spot_is_worth_nothing(farm, optimum):
    stations, turbines, w = farm
    assert optimum(stations[[0, 1, 0]], turbines, w) == pytest.approx(optimum(*farm))


def test_one_turbine_more_is_never_cheaper(farm, optimum):
    stations, turbines, w = farm
    assert optimum(stations, turbines[:-1], w) <= optimum(*farm) * (1 + 1e-9)


def test_longer_flights_and_more_stations_are_never_dearer(farm, optimum):
    stations, turbines, w = farm
    shorter, longer = optimum(*farm, t_max=1000.0), optimum(*farm, t_max=1600.0)
    assert longer <= shorter * (1 + 1e-9)
    assert optimum(*farm) <= optimum(stations[:1], turbines, w, t_max=T_MAX) * (1 + 1e-9)


def test_two_farms_far_apart_cost_the_sum(farm, optimum):
    stations, turbines, w = farm
    first, second = (stations[:1], turbines[:3]), (stations[1:], turbines[3:])
    far = np.array([1e6, 0.0])
    together = optimum(
        np.vstack([first[0], second[0] + far]), np.vstack([first[1], second[1] + far]), w
    )
    assert together == pytest.approx(optimum(*first, w) + optimum(*second, w))


def test_each_uav_flies_as_fast_and_as_long_as_it_can(routing):
    """The second UAV is faster, but its battery reaches only the nearer turbine."""
    turbines = np.array([[1600.0, 0.0], [3200.0, 0.0]])
    calm = np.zeros(2)
    t = np.concatenate(
        [routing.flight_times(np.zeros((1, 2)), turbines, calm, u_max=u) for u in (8.0, 16.0)]
    )
    program = time_flow(t, [800.0, 200.0])
    result = solve(program)
    assert result.objective == pytest.approx(800.0)
    assert program.routes(result.solution) in ([(0, (0, 1))], [(0, (1, 0))])
    split = time_flow(t, [800.0, 200.0], allowed=np.array([[False, True], [True, True]]))
    assert solve(split).objective == pytest.approx(800.0 + 200.0)


def test_a_turbine_that_nobody_may_serve_makes_it_infeasible(farm, routing):
    t = routing.flight_times(*farm)
    allowed = np.ones((2, 6), dtype=bool)
    allowed[:, 4] = False
    assert solve(time_flow(t, T_MAX, allowed=allowed)).status is Status.INFEASIBLE


def test_turbines_on_one_spot_are_on_one_flight():
    """Legs that take no time would let a subtour through the flow: only (8) forbids it."""
    t = np.zeros((5, 5))
    t[0, 1:] = t[1:, 0] = 300.0
    result = solve(time_flow(t, 600.0))
    assert result.objective == pytest.approx(600.0)


def test_a_flight_too_long_by_less_than_the_solver_notices_is_refused():
    t = np.array([[0.0, 400.0, 400.0], [400.0, 0.0, 200.0], [400.0, 200.0, 0.0]])
    assert solve(time_flow(t, 1000.0)).objective == pytest.approx(1000.0)
    assert solve(time_flow(t, 1000.0 - 1e-4)).objective == pytest.approx(1600.0)


def test_rows_of_an_experimenter_are_kept(farm, routing):
    t = routing.flight_times(*farm)
    free = solve(time_flow(t, 1600.0))
    program = time_flow(t, 1600.0)
    program.model.addConstr(program.x[0, 0].sum() == 0)  # station 0 stays on the ground
    forced = solve(program)
    assert forced.solution[0].sum() == 0
    assert forced.objective == pytest.approx(solve(time_flow(t[1:], 1600.0)).objective)
    assert forced.objective >= free.objective


@pytest.mark.parametrize(
    ("t", "t_max", "message"),
    [
        (np.zeros((3, 2)), 1.0, "shape"),
        (np.full((3, 3), np.nan), 1.0, "t >= 0"),
        (-np.ones((3, 3)), 1.0, "t >= 0"),
        (np.ones((3, 3)), 0.0, "t_max > 0"),
    ],
)
def test_numbers_that_mean_nothing_are_refused(t, t_max, message):
    with pytest.raises(ValueError, match=message):
        time_flow(t, t_max)


@pytest.mark.slow
@pytest.mark.parametrize(("k", "n"), [(1, 15), (2, 16)])
def test_it_proves_the_sizes_it_promises(k, n, routing):
    """Tight flights in a strong wind; a minute is what is promised."""
    rng = np.random.default_rng(1)
    turbines, stations = rng.uniform(0, 8000, (n, 2)), rng.uniform(0, 8000, (k, 2))
    t = routing.flight_times(stations, turbines, [0.0, -10.0])
    t_max = 1.1 * (t[:, 0, 1:] + t[:, 1:, 0]).min(axis=0).max()
    result = solve(time_flow(t, t_max), time_limit=60.0)
    assert result.status is Status.OPTIMAL
    assert result.gap < 1e-9


def test_two_hundred_turbines_and_ten_stations_are_built_in_bulk(routing):
    rng = np.random.default_rng(0)
    t = routing.flight_times(
        rng.uniform(0, 20000, (10, 2)), rng.uniform(0, 20000, (200, 2)), [0.0, -10.0]
    )
    program = time_flow(t, 1800.0)
    assert program.x.shape == (10, 201, 201)
    assert program.model.getNumRow() > 50_000
