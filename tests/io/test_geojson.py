"""GeoJSON: places on the globe, and what is known about them."""

import json

import pytest

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station
from windopt.domain.plan import Flight, InspectionPlan, Unreachable
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.errors import InvalidInput
from windopt.io.geojson import geojson, write_geojson

# On the central meridian of zone 31, and a degree and a half to the north of the equator.
FARM = Farm(
    "three",
    (Turbine("A", 500e3, 0.0), Turbine("B", 500e3, 1e3), Turbine("C", 500e3, 165_810.0)),
    crs="EPSG:32631",
    substations=((500e3, 500.0),),
)
PLAN = InspectionPlan(
    FARM,
    Fleet((Station("S1", 500e3, 0.0),)),
    Wind(0.0, 0.0),
    (0.0,) * 3,
    (Flight("S1", "AscTec Falcon 8", ("A", "B"), (0.0, 62.5, 62.5), 125.0),),
    (Unreachable("C", "Too far."),),
)


def of_kind(kind, collection):
    return [f for f in collection["features"] if f["properties"]["kind"] == kind]


def test_turbines_stand_at_their_longitude_and_latitude():
    turbines = of_kind("turbine", geojson(FARM))
    assert [turbine["properties"]["name"] for turbine in turbines] == ["A", "B", "C"]
    assert turbines[0]["geometry"] == {"type": "Point", "coordinates": [3.0, 0.0]}
    assert turbines[2]["geometry"]["coordinates"] == pytest.approx([3.0, 1.5], abs=1e-3)


def test_a_flight_is_a_line_that_ends_where_it_starts():
    (flight,) = of_kind("flight", geojson(PLAN))
    line = flight["geometry"]["coordinates"]
    assert flight["geometry"]["type"] == "LineString"
    assert len(line) == 4
    assert line[0] == line[-1] == [3.0, 0.0]
    assert flight["properties"]["turbines"] == ["A", "B"]
    assert flight["properties"]["duration"] == 125.0


def test_a_turbine_out_of_reach_says_why():
    known = {t["properties"]["name"]: t["properties"] for t in of_kind("turbine", geojson(PLAN))}
    assert not known["A"]["unreachable"]
    assert known["C"]["unreachable"]
    assert known["C"]["reason"] == "Too far."


def test_stations_and_substations_are_there():
    collection = geojson(PLAN)
    assert collection["type"] == "FeatureCollection"
    assert of_kind("station", collection)[0]["properties"]["name"] == "S1"
    assert len(of_kind("substation", collection)) == 1


def test_without_a_coordinate_system_there_is_no_map():
    with pytest.raises(InvalidInput, match="crs to be known"):
        geojson(Farm("nowhere", (Turbine("A", 0.0, 0.0),)))


def test_what_is_written_is_the_collection(tmp_path):
    path = write_geojson(PLAN, tmp_path / "plan.geojson")
    assert json.loads(path.read_text()) == geojson(PLAN)
    with pytest.raises(InvalidInput, match="--force"):
        write_geojson(PLAN, path)
