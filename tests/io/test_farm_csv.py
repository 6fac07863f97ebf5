"""Farms as tables: metres or degrees, and the cell that is at fault."""

import gzip
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from windopt.domain.turbine import SG_8_167
from windopt.errors import InvalidInput
from windopt.io.farm_csv import farm_from_csv


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "farm.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def test_metres_are_kept(write):
    farm = farm_from_csv(write("name,x,y\nA1,0,0\nA2,500.5,-3e2\n"))
    assert (farm.name, farm.names, farm.crs) == ("farm", ("A1", "A2"), None)
    assert farm.xy.tolist() == [[0, 0], [500.5, -300]]
    assert farm.turbines[0].type == SG_8_167
    assert any("SG 8.0-167 DD is assumed" in note for note in farm.notes)


def test_degrees_are_projected_to_their_utm_zone(write):
    farm = farm_from_csv(write("name,lon,lat\nA1,3.0,0.0\nA2,3.1,54.0\n"))
    assert farm.crs == "EPSG:32631"
    assert farm.turbines[0].x == pytest.approx(500_000)


def test_turbines_without_names_are_numbered(write):
    assert farm_from_csv(write("x,y\n0,0\n1,1\n")).names == ("T01", "T02")


def test_ratings_scale_rotors_once_per_rating(write):
    farm = farm_from_csv(write("name,x,y,rated_power_mw\nA,0,0,2\nB,1,1,2\nC,2,2,7\n"))
    assert [turbine.type.rated_power for turbine in farm.turbines] == [2e6, 2e6, 7e6]
    assert farm.turbines[0].type is farm.turbines[1].type
    assert any("rotors are scaled" in note for note in farm.notes)


@pytest.mark.parametrize(
    "text",
    [
        "\ufeffNAME; Easting ; Northing\nA; 1 ; 2\n",
        "# made by hand\n\nname\tX\tY\n\nA\t1\t2",
        'name,x,y\r\n"A",1,2\r\n',
        gzip.compress(b"name,x,y\nA,1,2\n", mtime=0),
        "crs,y,x,name\nEPSG:32630,2,1,A\n",
    ],
)
def test_tables_come_in_many_dresses(write, text):
    farm = farm_from_csv(write(text))
    assert farm.names == ("A",)
    assert farm.xy.tolist() == [[1, 2]]


def test_a_crs_column_is_kept(write):
    assert farm_from_csv(write("name,x,y,crs\nA,1,2,30U\nB,1,3,30U\n")).crs == "EPSG:32630"
    with pytest.raises(InvalidInput, match="the same in each row"):
        farm_from_csv(write("name,x,y,crs\nA,1,2,30U\nB,1,3,31U\n"))


def test_a_crs_column_beside_degrees_is_noted(write):
    farm = farm_from_csv(write("name,lon,lat,crs\nA,3,54,EPSG:4326\n"))
    assert farm.crs == "EPSG:32631"
    assert any("crs" in note and "EPSG:32631" in note for note in farm.notes)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "an empty file"),
        ("\n\n", "an empty file"),
        ("# nothing\n", "an empty file"),
        ("name,x,y\n", "rows below its header"),
        ("name,x\nA,1\n", "x and y, or lon and lat"),
        ("name,x,y\nA,1,2\nB,one,2\n", "'x' in line 3 to be a number, got 'one'"),
        ("name,x,y\nA,1,2\n\nB,nan,2\n", "'x' in line 4 to be a finite number"),
        ("name,x,y\nA,1,\n", "'y' in line 2 to be a number, got ''"),
        ("name,x,y\nA,1,2\nB,1\n", "line 3 to have 3 cells, got 2"),
        ("name,x,x,y\nA,1,2,3\n", "one column 'x'"),
        ("name,x,y\nA,1,2\nA,2,2\n", "A more than once"),
        ("name,x,y\n,1,2\n", "'name' in line 2 to be a name"),
        ("name,lon,lat\nA,200,2\n", "within 180"),
        ("name,x,y,rated_power_mw\nA,1,2,0\n", "'rated_power_mw' in line 2 > 0 MW"),
        ("name,x,y,rated_power_mw\nA,1,2,-3\n", "> 0 MW, got '-3'"),
        ("name,x,y,crs\nA,1,2,30U\nB,1,3,31U\n", "'crs' in line 3 to be the same"),
        (b"name,x,y\nA,1,\x00", "a text file"),
        (gzip.compress(b"name,x,y\nA,1,2\n" * 99, mtime=0)[:-9], "readable file"),
    ],
)
def test_what_cannot_be_used_is_named(write, text, complaint):
    with pytest.raises(InvalidInput, match=complaint):
        farm_from_csv(write(text))


CELLS = st.sampled_from(["name", "x", "y", "lon", "lat", "crs", "1", "-2.5", "1e300", "nan", '"'])


@given(st.lists(st.lists(CELLS | st.text(max_size=3), max_size=4).map(",".join)).map("\n".join))
def test_no_table_makes_the_reader_stumble(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("csv") / "farm.csv"
    path.write_text(text, encoding="utf-8", newline="")
    with suppress(InvalidInput):
        farm_from_csv(path)
