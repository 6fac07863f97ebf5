"""What the times of legs say about flights."""

import numpy as np
import pytest

from formulations.network import network


def test_the_shortest_way_may_pass_other_turbines_but_no_station():
    t = np.array([[0.0, 100.0, 10.0], [10.0, 0.0, 100.0], [100.0, 20.0, 0.0]])
    arcs = network(t, 1000.0)
    assert arcs.alpha[0] * 1000.0 == pytest.approx([0.0, 30.0, 10.0])
    assert arcs.omega[0] * 1000.0 == pytest.approx([0.0, 10.0, 30.0])
    assert arcs.shortest[0, 1, 2] == 0.1  # by way of the station it would take 20 s


def test_each_turbine_alone_belongs_to_the_station_that_is_back_first():
    t = np.zeros((2, 3, 3))
    t[0, 0, 1:], t[1, 0, 1:] = [100.0, 300.0], [200.0, 250.0]
    alone = network(t, 1000.0).alone
    assert np.argwhere(alone).tolist() == [[0, 0, 1], [0, 1, 0], [1, 0, 2], [1, 2, 0]]


@pytest.mark.parametrize(
    ("t_max", "allowed"),
    [([50.0, 1000.0], None), (1000.0, np.array([[False], [True]]))],
    ids=["too far for the nearer station", "forbidden to the nearer station"],
)
def test_a_turbine_alone_is_left_to_a_station_that_can_serve_it(t_max, allowed):
    t = np.zeros((2, 2, 2))
    t[:, 0, 1] = [100.0, 200.0]
    alone = network(t, t_max, allowed).alone
    assert np.argwhere(alone).tolist() == [[1, 0, 1], [1, 1, 0]]


def test_a_turbine_that_no_station_reaches_is_on_no_flight_of_its_own():
    t = np.full((1, 3, 3), 100.0)
    t[0, 0, 2] = np.inf
    assert np.argwhere(network(t, 1000.0).alone).tolist() == [[0, 0, 1], [0, 1, 0]]


def test_a_farm_without_turbines_is_refused():
    with pytest.raises(ValueError, match="at least one turbine"):
        network(np.zeros((1, 1, 1)), 100.0)
