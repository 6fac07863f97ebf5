"""Tables that say something of turbines by name."""

import pytest

from windopt.errors import InvalidInput
from windopt.io.turbine_tables import read_numbers, read_stations_of_turbines


@pytest.fixture
def table(tmp_path):
    def table(text):
        path = tmp_path / "table.csv"
        path.write_text(text)
        return path

    return table


def test_numbers_are_read_by_turbine(table):
    assert read_numbers(table("turbine,worth,who\nA,1.5,x\nB,2,y\n"), "worth") == {"A": 1.5, "B": 2}


def test_a_turbine_may_have_several_stations(table):
    stations = read_stations_of_turbines(table("turbine,station\nA,S1\nB,S2\nA,S2\n"))
    assert stations == {"A": ("S1", "S2"), "B": ("S2",)}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("turbine,worth\nA,1\nA,2\n", "'turbine' in line 3 to be named once"),
        ("turbine,worth\nA,much\n", "'worth' in line 2 to be a number"),
        ("turbine,worth\n,1\n", "'turbine' in line 2 to be a name"),
        ("name,worth\nA,1\n", "one column 'turbine'"),
    ],
)
def test_a_table_that_cannot_be_read_is_named(table, text, sentence):
    with pytest.raises(InvalidInput, match=sentence):
        read_numbers(table(text), "worth")
