"""Stations placed by k-means: as few as reach every turbine."""

import numpy as np
import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.reach import in_reach, routing_instance
from windopt.planning.stations import design_winds, stations_by_k_means


def row(n, spacing):
    return Farm("row", tuple(Turbine(f"T{i}", spacing * i, 0.0) for i in range(n)))


def test_a_small_farm_needs_one_station():
    assert len(stations_by_k_means(row(5, 500.0))) == 1


def test_every_turbine_is_within_reach_of_as_few_stations_as_that_takes():
    farm = row(20, 1500.0)
    fleet = stations_by_k_means(farm)
    assert len(fleet) > 1
    for wind in design_winds(FALCON_8):
        assert routing_instance(farm, fleet, wind, dwell=[0.0] * 20).reachable.any(axis=0).all()
    fewer = stations_by_k_means(farm, len(fleet) - 1)
    assert not all(
        routing_instance(farm, fewer, wind, dwell=[0.0] * 20).reachable.any(axis=0).all()
        for wind in design_winds(FALCON_8)
    )


def test_longer_dwells_need_more_stations():
    farm = row(20, 1500.0)
    assert len(stations_by_k_means(farm, dwell=600.0)) > len(stations_by_k_means(farm))


def test_a_slow_uav_needs_stations_for_winds_it_can_fly_in():
    slow = Uav(airspeed=8.0)
    assert max(wind.speed for wind in design_winds(slow)) == pytest.approx(5.0)
    farm = row(20, 1500.0)
    assert len(stations_by_k_means(farm)) < len(stations_by_k_means(farm, uav=slow)) < 20


def test_winds_faster_than_the_uav_need_no_station():
    slow = Uav(airspeed=8.0)
    assert len(stations_by_k_means(row(5, 500.0), uav=slow, winds=[Wind.from_met(10, 0)])) == 1


def test_a_dwell_as_long_as_a_flight_needs_a_station_at_each_turbine():
    assert len(stations_by_k_means(row(5, 500.0), dwell=FALCON_8.t_max)) == 5


@pytest.mark.parametrize("cap", [True, False])
def test_reach_is_the_same_with_and_without_the_times_between_turbines(cap):
    farm, wind = row(20, 1500.0), Wind.from_met(9.0, 50.0)
    fleet = stations_by_k_means(farm, 3, uav=Uav(ground_speed_cap=cap))
    dwell = [300.0 * (i % 2) for i in range(20)]
    instance = routing_instance(farm, fleet, wind, dwell=dwell)
    assert (in_reach(farm, fleet, wind, dwell=dwell) == instance.reachable).all()


def test_winds_that_the_uav_does_not_fly_in_need_no_station():
    calm = Uav(wind_max=5.0)
    assert len(stations_by_k_means(row(5, 500.0), uav=calm, winds=[Wind.from_met(20, 0)])) == 1


@pytest.mark.parametrize("count", [0, -1, 6])
def test_the_number_of_stations_is_that_of_turbines_at_most(count):
    with pytest.raises(InvalidInput, match="stations"):
        stations_by_k_means(row(5, 500.0), count)


def test_a_dwell_that_leaves_no_time_to_fly_is_refused():
    with pytest.raises(InvalidInput, match="dwell"):
        stations_by_k_means(row(5, 500.0), dwell=2000.0)


def test_the_same_seed_places_the_same_stations():
    farm = Farm(
        "random",
        tuple(
            Turbine(f"T{i}", *xy)
            for i, xy in enumerate(np.random.default_rng(0).uniform(0, 2e4, (40, 2)).tolist())
        ),
    )
    assert stations_by_k_means(farm, 4, seed=1) == stations_by_k_means(farm, 4, seed=1)
