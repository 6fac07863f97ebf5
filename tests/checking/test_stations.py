"""The checker of stations finds what is beyond reach."""

from dataclasses import replace

from windopt.checking.stations import check_stations
from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind

# 16 m/s against 10 m/s of wind, and no faster than 16 m/s with it: 1/6 + 1/16 s a metre.
PACE = 1 / 6 + 1 / 16
FAR = 1080.0 / PACE
HEAD = [Wind.from_met(10.0, 90.0)]


def passes(x, *, dwell=0.0, margin=0.0, uav=None, winds=HEAD):
    farm = Farm("one", (Turbine("A", x, 0.0),))
    fleet = Fleet((Station("S", 0.0, 0.0, uav or Uav()),))
    return check_stations(farm, fleet, winds, dwell=[dwell], margin=margin).passed


def test_reach_ends_where_the_battery_does():
    assert passes(FAR * (1 - 1e-6))
    assert not passes(FAR * (1 + 1e-6))


def test_margin_and_dwell_shorten_it():
    assert passes(0.8 * FAR * (1 - 1e-6), margin=0.2)
    assert not passes(0.8 * FAR * (1 + 1e-6), margin=0.2)
    assert passes((1080.0 - 60.0) / PACE * (1 - 1e-6), dwell=60.0)
    assert not passes((1080.0 - 60.0) / PACE * (1 + 1e-6), dwell=60.0)


def test_one_bad_wind_is_enough():
    assert passes(FAR * 1.2, winds=[Wind.from_met(0.0, 0.0)])
    assert not passes(FAR * 1.2, winds=[Wind.from_met(0.0, 0.0), *HEAD])


def test_a_turbine_needs_one_station_that_reaches_it_in_all_winds():
    farm = Farm("two", (Turbine("A", 0.0, 0.0), Turbine("B", 3 * FAR, 0.0)))
    both = Fleet((Station("S", 0.0, 0.0), Station("T", 3 * FAR, 0.0)))
    assert check_stations(farm, both, HEAD, dwell=[0.0, 0.0], margin=0.0).passed
    one = replace(both, stations=both.stations[:1])
    report = check_stations(farm, one, HEAD, dwell=[0.0, 0.0], margin=0.0)
    assert "turbine B is beyond" in report.violations[0]
