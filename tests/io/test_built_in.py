"""What comes with windopt is whole, and fits together."""

import numpy as np
import pytest

from windopt.domain.fleet import Uav
from windopt.domain.wind import Wind
from windopt.io.built_in import DATA, built_in_farm, built_in_series, built_in_stations


def test_walney_is_three_farms_of_189_turbines():
    farm = built_in_farm()
    phases = [name[1] for name in farm.names]
    assert [phases.count(phase) for phase in "1234"] == [51, 51, 40, 47]
    assert (farm.name, farm.crs, len(farm.substations)) == ("Walney", "EPSG:32630", 4)
    power = sum(turbine.type.rated_power for turbine in farm.turbines)
    assert power == pytest.approx(2 * 51 * 3.6e6 + 40 * 8.25e6 + 47 * 7e6)


def test_walney_has_the_turbines_of_the_paper():
    names = set(built_in_farm().names)
    assert {"B110", "C214", "A106", "E105", "A411", "A213", "D101"} <= names


def test_walneys_turbines_stand_apart():
    x, y = built_in_farm().xy.T
    distance = np.hypot(x[:, None] - x, y[:, None] - y) + np.diag(np.full(len(x), np.inf))
    assert 400 < distance.min() < 1000  # m; four rotors at least


@pytest.mark.parametrize("speed", [0.0, 10.0, 12.0])
def test_every_turbine_is_within_reach_wherever_the_wind_blows_from(speed):
    uav = Uav()
    farm, fleet = built_in_farm(), built_in_stations()
    stations = np.array([(station.x, station.y) for station in fleet.stations])
    out = farm.xy[:, None] - stations
    length = np.linalg.norm(out, axis=2)
    for direction in range(0, 360, 5):
        w = Wind.from_met(speed, direction).velocity
        along = out @ w / length
        across = (out[..., 0] * w[1] - out[..., 1] * w[0]) / length
        still = np.sqrt(uav.airspeed**2 - across**2)
        there, back = (np.minimum(uav.airspeed, still + sign * along) for sign in (1, -1))
        assert (length / there + length / back).min(axis=1).max() < uav.t_max


def test_stations_keep_the_uav_asked_for():
    slow = Uav(airspeed=9.0)
    assert {station.uav for station in built_in_stations(slow).stations} == {slow}


def test_the_wind_is_a_month_without_gaps():
    series = built_in_series()
    assert len(series) == 31 * 144
    assert series.time[0] == np.datetime64("2009-01-01")
    assert series.step_seconds == 600
    assert series.valid.all()
    assert series.speed.max() < 30
    assert "foxes" in series.source


def test_sources_and_licences_are_named():
    notice = (DATA / "NOTICE.md").read_text()
    for path in DATA.glob("wal*"):
        assert path.name in notice
    for holder in ("Technical University of Denmark", "FraunhoferIWES", "MIT"):
        assert holder in notice
