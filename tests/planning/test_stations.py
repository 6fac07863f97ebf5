"""Stations by an exact cover and by k-means: as few as reach every turbine."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.planning.reach import routing_instance
from windopt.planning.station_design import station_design
from windopt.planning.stations import design_winds, stations_by_cover, stations_by_k_means
from windopt.result import Status

MARGINS = (0.0, 0.05, 0.2, 0.4)


def row(n, spacing):
    return Farm("row", tuple(Turbine(f"T{i}", spacing * i, 0.0) for i in range(n)))


def random_farm(n, seed):
    xy = np.random.default_rng(seed).uniform(0, 2e4, (n, 2)).tolist()
    return Farm("random", tuple(Turbine(f"T{i}", *at) for i, at in enumerate(xy)))


def found_by_cover(farm, **options):
    return stations_by_cover(farm, **options).found()


@pytest.mark.parametrize("place", [stations_by_k_means, found_by_cover])
def test_a_small_farm_needs_one_station(place):
    assert len(place(row(5, 500.0))) == 1


@pytest.mark.parametrize("seed", range(2))
def test_every_turbine_is_within_reach_in_each_design_wind_with_the_margin(seed):
    farm, margin = random_farm(30, seed), 0.1
    fleet = stations_by_cover(farm, margin=margin, dwell=60.0).found()
    tired = replace(FALCON_8, t_max=FALCON_8.t_max * (1 - margin) * (1 + 1e-9))
    kept = Fleet(tuple(replace(station, uav=tired) for station in fleet.stations))
    for wind in design_winds(FALCON_8):
        instance = routing_instance(farm, kept, wind, dwell=[60.0] * 30)
        assert instance.reachable.any(axis=0).all()


@pytest.mark.parametrize("seed", range(2))
def test_a_cover_never_needs_more_stations_than_k_means(seed):
    farm = random_farm(30, seed)
    result, by_k_means = stations_by_cover(farm), stations_by_k_means(farm, margin=0.05)
    assert result.status is Status.OPTIMAL
    assert result.objective == result.bound == len(result.found()) <= len(by_k_means)
    same = stations_by_cover(farm, len(by_k_means))
    assert same.status is Status.OPTIMAL
    assert same.objective <= station_design(farm).total_time(by_k_means) * (1 + 1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_the_fewest_sites_equal_enumeration_and_so_do_the_quickest(seed):
    farm = random_farm(8, seed)
    t = station_design(farm).round_trips(farm.xy)
    covers = [c for p in range(1, 9) for c in map(list, combinations(range(8), p))]
    covers = [c for c in covers if np.isfinite(t[c]).any(axis=0).all()]
    fewest = min(map(len, covers))
    result = stations_by_cover(farm, candidates="turbines")
    assert result.objective == fewest
    for count in range(fewest, 6):
        best = min(t[c].min(axis=0).sum() for c in covers if len(c) == count)
        quickest = stations_by_cover(farm, count, candidates="turbines")
        assert quickest.objective == pytest.approx(best)
        if count == fewest:
            assert station_design(farm).total_time(result.found()) == pytest.approx(best)


def test_a_wider_margin_never_needs_fewer_stations():
    farm = random_farm(30, 0)
    numbers = [stations_by_cover(farm, margin=m, candidates="turbines").objective for m in MARGINS]
    assert numbers == sorted(numbers)
    assert numbers[0] < numbers[-1]


def test_longer_flights_never_need_more_stations():
    farm = random_farm(30, 0)
    fleets = [
        stations_by_cover(farm, uav=Uav(t_max=t_max), candidates="turbines")
        for t_max in (700.0, 1080.0, 1500.0, 3000.0)
    ]
    numbers = [-fleet.objective for fleet in fleets]
    assert numbers == sorted(numbers)
    assert numbers[0] < numbers[-1]


def test_too_few_stations_are_infeasible_and_say_how_many_it_takes():
    farm = row(20, 1500.0)
    least = stations_by_cover(farm).objective
    result = stations_by_cover(farm, int(least) - 1)
    assert result.status is Status.INFEASIBLE
    assert f"takes {least:.0f} or more" in result.reason


def test_a_turbine_that_no_site_reaches_is_named():
    result = stations_by_cover(row(3, 5000.0), candidates=np.array([[0.0, 0.0]]))
    assert result.status is Status.INFEASIBLE
    assert "turbine T1 (nor 1 others)" in result.reason


def test_a_dwell_longer_than_a_flight_less_the_margin_is_infeasible_and_named():
    result = stations_by_cover(row(3, 500.0), dwell=[0.0, 1060.0, 0.0])
    assert result.status is Status.INFEASIBLE
    assert "turbine T1: its dwell is 1060 s, a flight may last 1026 s" in result.reason


@pytest.mark.parametrize(
    ("field", "options"),
    [
        ("stations", {"count": 0}),
        ("stations", {"count": 10_000}),
        ("margin", {"margin": 1.0}),
        ("margin", {"margin": -0.1}),
        ("margin", {"margin": float("nan")}),
        ("dwell", {"dwell": -1.0}),
        ("time_limit", {"time_limit": -1.0}),
        ("candidates", {"candidates": "moon"}),
        ("candidates", {"candidates": "substations"}),
        ("candidates", {"candidates": np.array([[0.0, np.nan]])}),
        ("candidates", {"candidates": np.zeros((2, 3))}),
    ],
)
def test_what_cannot_be_used_is_refused_by_name(field, options):
    with pytest.raises(InvalidInput, match=field):
        stations_by_cover(row(5, 500.0), **options)


def test_no_time_gives_no_stations_rather_than_an_error():
    assert stations_by_cover(row(20, 1500.0), time_limit=0.0).status is Status.NO_SOLUTION


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


@pytest.mark.parametrize("place", [stations_by_k_means, stations_by_cover])
@pytest.mark.parametrize("uav", [Uav(airspeed=8.0), Uav(wind_max=5.0)])
def test_winds_that_no_uav_flies_in_are_refused(place, uav):
    with pytest.raises(InvalidInput, match="winds"):
        place(row(5, 500.0), uav=uav, winds=[Wind.from_met(10, 0)])


@pytest.mark.parametrize("place", [stations_by_k_means, found_by_cover])
def test_winds_that_the_uav_does_not_fly_in_are_left_out(place):
    calm, storm = Wind.from_met(5, 0), Wind.from_met(20, 0)
    assert place(row(5, 500.0), winds=[calm, storm]) == place(row(5, 500.0), winds=[calm])


def test_a_dwell_as_long_as_a_flight_needs_a_station_at_each_turbine():
    assert len(stations_by_k_means(row(5, 500.0), dwell=FALCON_8.t_max)) == 5


@pytest.mark.parametrize("count", [0, -1, 6])
def test_the_number_of_stations_is_that_of_turbines_at_most(count):
    with pytest.raises(InvalidInput, match="stations"):
        stations_by_k_means(row(5, 500.0), count)


def test_a_dwell_that_leaves_no_time_to_fly_is_refused():
    with pytest.raises(InvalidInput, match="dwell"):
        stations_by_k_means(row(5, 500.0), dwell=2000.0)


@pytest.mark.parametrize("place", [stations_by_k_means, found_by_cover])
def test_the_same_seed_places_the_same_stations(place):
    farm = random_farm(40, 0)
    assert place(farm, seed=1) == place(farm, seed=1)
