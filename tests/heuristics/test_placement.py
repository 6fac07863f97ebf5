"""Placement and assignment on layouts whose answer is plain to see, and under symmetries."""

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.errors import InvalidInput
from windopt.heuristics.placement import nearest_stations, place_stations


def layout(stations, turbines):
    """Where stations and turbines stand; flights play no part in the assignment."""
    k, n = len(stations), len(turbines)
    return RoutingInstance(
        t=np.zeros((k, n + 1, n + 1)),
        t_max=np.ones(k),
        stations=np.asarray(stations, dtype=float),
        turbines=np.asarray(turbines, dtype=float),
        w=np.zeros(2),
        allowed=np.ones((k, n), dtype=bool),
    )


def spread(turbines, stations):
    return np.hypot(*(turbines[:, None] - stations[None]).transpose(2, 0, 1)).min(axis=1)


def clusters():
    rng = np.random.default_rng(1)
    centres = np.array([(0.0, 0.0), (9000.0, 0.0), (0.0, 9000.0)])
    return np.vstack([c + rng.normal(0.0, 300.0, (20, 2)) for c in centres]), centres


def test_stations_stand_in_the_middle_of_separate_clusters():
    turbines, centres = clusters()
    assert (spread(centres, place_stations(turbines, 3)) < 300.0).all()


def test_one_station_stands_at_the_mean():
    turbines, _ = clusters()
    assert place_stations(turbines, 1)[0] == pytest.approx(turbines.mean(axis=0))


def test_as_many_stations_as_turbines_stand_at_the_turbines():
    turbines, _ = clusters()
    assert spread(turbines, place_stations(turbines, 60)) == pytest.approx(0.0)


def test_turbines_on_one_another_do_not_stop_the_placement():
    assert place_stations(np.ones((4, 2)), 3) == pytest.approx(1.0)


def test_the_same_seed_gives_the_same_stations():
    turbines, _ = clusters()
    assert np.array_equal(place_stations(turbines, 5, seed=3), place_stations(turbines, 5, seed=3))


def test_moving_the_farm_moves_the_stations():
    turbines, _ = clusters()
    shift = np.array([4e5, 6e6])
    moved = place_stations(turbines + shift, 3)
    assert moved - shift == pytest.approx(place_stations(turbines, 3), abs=1e-6)


@pytest.mark.parametrize("k", [0, 61])
def test_an_impossible_number_of_stations_is_refused(k):
    with pytest.raises(InvalidInput, match="k between 1 and 60"):
        place_stations(clusters()[0], k)


def test_each_turbine_belongs_to_the_nearest_station():
    instance = layout([(0, 0), (10, 0)], [(1, 0), (9, 9), (4, 0)])
    assert nearest_stations(instance).tolist() == [0, 1, 0]
