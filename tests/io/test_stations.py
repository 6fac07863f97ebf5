"""Stations as tables."""

import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.errors import InvalidInput
from windopt.io.stations import read_stations, write_stations

SLOW = Uav("slow", airspeed=9.0, t_max=600.0, wind_max=8.0, ground_speed_cap=False)


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "stations.csv"
        path.write_text(text)
        return path

    return write


def test_all_stations_keep_the_same_uav(write):
    fleet = read_stations(write("id,x,y\nS1,1.5,2\nS2,3,4\n"), uav=SLOW)
    assert fleet == Fleet((Station("S1", 1.5, 2.0, SLOW), Station("S2", 3.0, 4.0, SLOW)))


def test_a_station_may_have_limits_of_its_own(write):
    fleet = read_stations(write("id,x,y,airspeed,t_max,wind_max\nS1,1,2,20,900,\n"))
    assert fleet.stations[0].uav == Uav(airspeed=20.0, t_max=900.0)


def test_a_station_may_be_short_of_flights(write, tmp_path):
    fleet = read_stations(write("id,x,y,max_flights\nS1,1,2,3\nS2,1,2,\n"))
    assert [station.max_flights for station in fleet.stations] == [3, None]
    assert read_stations(write_stations(fleet, tmp_path / "again.csv")) == fleet
    with pytest.raises(InvalidInput, match="'max_flights' in line 2 to be a whole number"):
        read_stations(write("id,x,y,max_flights\nS1,1,2,1.5\n"))


def test_degrees_are_projected_to_the_farms_system(write):
    farm = Farm("one", (Turbine("A", 500_000.0, 0.0),), crs="EPSG:32631")
    station = read_stations(write("id,lon,lat\nS1,3,0\n"), farm).stations[0]
    assert (station.x, station.y) == pytest.approx((500_000.0, 0.0), abs=1e-6)


@pytest.mark.parametrize("farm", [None, Farm("one", (Turbine("A", 0.0, 0.0),))])
def test_degrees_need_a_farm_whose_system_is_known(write, farm):
    with pytest.raises(InvalidInput, match="no known CRS"):
        read_stations(write("id,lon,lat\nS1,3,0\n"), farm)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("id,x,y\n", "rows below its header"),
        ("x,y\n1,2\n", "a column id"),
        ("id,x\nS1,2\n", "x and y, or lon and lat"),
        ("id,x,y\nS1,1,2\nS1,3,4\n", "S1 more than once"),
        ("id,x,y\n,1,2\n", "'id' in line 2 to be a name"),
        ("id,x,y\nS1,1,far\n", "'y' in line 2"),
        ("id,x,y,t_max\nS1,1,2,-3\n", "'t_max' in line 2 > 0 s, got '-3'"),
        ("id,x,y,airspeed\nS1,1,2,\nS2,3,4,0\n", "'airspeed' in line 3 > 0 m/s, got '0'"),
        ("id,x,y,airspeed\nS1,1,2,fast\n", "'airspeed' in line 2"),
    ],
)
def test_what_cannot_be_used_is_named(write, text, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        read_stations(write(text))


def test_what_is_written_is_read_back(tmp_path):
    uav = Uav(airspeed=1 / 3, t_max=1e3, wind_max=0.1)
    fleet = Fleet((Station('the "old", one', 1 / 3, 5.988e6, uav), Station("S2", 0.1, 0.2, uav)))
    path = write_stations(fleet, tmp_path / "stations.csv")
    assert read_stations(path) == fleet
    with pytest.raises(InvalidInput, match="--force"):
        write_stations(fleet, path)


def test_a_column_that_is_misspelt_is_refused(tmp_path):
    path = tmp_path / "stations.csv"
    path.write_text("id,x,y,maxflights,comment\nN,0,0,1,none\n")
    with pytest.raises(InvalidInput, match=r"Expected stations\.csv column max_flights, got maxfl"):
        read_stations(path)
    path.write_text("id,x,y,max_flights,maximum,flights\nN,0,0,1,9,9\n")
    assert read_stations(path).stations[0].max_flights == 1
