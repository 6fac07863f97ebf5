"""Farms and fleets at the door: what is refused, and with which words."""

from math import inf, nan

import numpy as np
import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.routing import Route, RoutingInstance
from windopt.domain.turbine import SG_8_167, Turbine, TurbineType
from windopt.errors import InvalidInput


def test_an_empty_farm_is_refused():
    with pytest.raises(InvalidInput, match="at least one turbine"):
        Farm("none", ())


def test_two_turbines_of_one_name_are_refused():
    with pytest.raises(InvalidInput, match="A1 more than once"):
        Farm("twice", (Turbine("A1", 0, 0), Turbine("A1", 1, 1)))


@pytest.mark.parametrize("x", [nan, inf])
def test_a_turbine_stands_somewhere(x):
    with pytest.raises(InvalidInput, match="x of turbine A1"):
        Turbine("A1", x, 0.0)


@pytest.mark.parametrize(
    "field", ["rated_power", "swept_area", "cut_in", "cut_out", "hub_height"]
)  # fmt: skip
def test_a_turbine_type_has_positive_sizes(field):
    sizes = {"rated_power": 8e6, "swept_area": 21_900.0} | {field: -1.0}
    with pytest.raises(InvalidInput, match=field):
        TurbineType("broken", **sizes)


def test_a_scaled_rotor_keeps_its_power_per_area():
    scaled = SG_8_167.scaled_to(2e6)
    assert scaled.swept_area == pytest.approx(21_900 / 4)
    assert scaled.rotor_diameter == pytest.approx(83.5, abs=0.1)


@pytest.mark.parametrize(
    ("field", "value"), [("airspeed", 0.0), ("t_max", nan), ("t_max", -3.0), ("wind_max", nan)]
)
def test_a_uav_that_cannot_fly_is_refused(field, value):
    with pytest.raises(InvalidInput, match=field):
        Uav(**{field: value})


def test_two_stations_of_one_name_are_refused():
    with pytest.raises(InvalidInput, match="station names"):
        Fleet((Station("S1", 0, 0), Station("S1", 1, 1)))
    with pytest.raises(InvalidInput, match="at least one station"):
        Fleet(())


def instance(**changes):
    given = {
        "t": np.array([[[0.0, 3.0, 5.0], [4.0, 0.0, 1.0], [2.0, 2.0, 0.0]]]),
        "t_max": np.array([7.0]),
        "stations": np.zeros((1, 2)),
        "turbines": np.zeros((2, 2)),
        "w": np.zeros(2),
        "allowed": np.ones((1, 2), bool),
    }
    return RoutingInstance(**(given | changes))


def test_a_route_lasts_from_take_off_to_landing():
    assert instance().duration(Route(0, (0, 1))) == 3 + 1 + 2
    assert instance().total((Route(0, (0,)), Route(0, (1,)))) == 7 + 7


def test_a_turbine_is_reachable_when_the_way_back_fits_too():
    assert instance().reachable.all()
    assert not instance(t_max=np.array([6.9])).reachable.any()
    assert instance(allowed=np.array([[True, False]])).reachable.tolist() == [[True, False]]


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"t": np.zeros((1, 2, 2))}, "t"),
        ({"t_max": np.zeros(2)}, "t_max"),
        ({"t": -np.ones((1, 3, 3))}, "t"),
        ({"t_max": np.array([0.0])}, "t_max"),
        ({"t_max": np.array([nan])}, "t_max"),
        ({"w": np.zeros(3)}, "w"),
        ({"airspeed": np.ones(2)}, "airspeed"),
        ({"airspeed": -1.0}, "airspeed"),
    ],
)
def test_an_instance_of_unequal_shapes_or_impossible_limits_is_refused(changes, field):
    with pytest.raises(InvalidInput, match=f"Expected {field} "):
        instance(**changes)


def test_an_instance_can_be_compared_and_hashed():
    one, other = instance(), instance()
    assert one == one
    assert len({one, other}) == 2


def test_a_subset_keeps_times_permissions_and_prizes_of_its_turbines():
    whole = instance(allowed=np.array([[False, True]]), prize=np.array([1.0, 2.0]))
    part = whole.subset([1])
    assert part.t.tolist() == [[[0.0, 5.0], [2.0, 0.0]]]
    assert part.allowed.tolist() == [[True]]
    assert part.prize.tolist() == [2.0]
    assert part.duration(Route(0, (0,))) == whole.duration(Route(0, (1,)))
    assert instance().subset([1, 0]).t[0, 1, 2] == 2.0
