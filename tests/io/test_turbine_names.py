"""Names made up where a source gives none, or one twice."""

from hypothesis import given
from hypothesis import strategies as st

from windopt.io.turbine_names import distinct_names


def test_nameless_turbines_are_numbered_by_their_place():
    names, notes = distinct_names(["A1", None, ""])
    assert names == ["A1", "T02", "T03"]
    assert notes == ("Turbines without a name, numbered in the source's order: 2.",)


def test_the_second_of_a_name_says_so():
    names, notes = distinct_names(["D36", "D36", "D36", "D37"])
    assert names == ["D36", "D36 (2)", "D36 (3)", "D37"]
    assert notes == ("Names given twice, told apart: D36 (2), D36 (3).",)


def test_good_names_stay_without_a_note():
    assert distinct_names(["A", "B"]) == (["A", "B"], ())


@given(st.lists(st.none() | st.sampled_from(["", "A", "A (2)", "T01", "T02", "T02 (2)", " A"])))
def test_names_are_distinct_and_first_ones_kept(labels):
    names, _ = distinct_names(labels)
    assert len(set(names)) == len(names) == len(labels)
    given_names = [(label or "").strip() for label in labels]
    for name in set(given_names) - {""}:
        assert names[given_names.index(name)] == name
