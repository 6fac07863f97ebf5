"""What was measured is shown and kept row by row."""

import pytest

from benchmarks.csv_table import tabulate


def test_rows_are_shown_and_kept(tmp_path, capsys):
    out = tmp_path / "table.csv"
    tabulate([("farm", "s"), ("Horns Rev 1, west", 3)], out)
    assert out.read_text(encoding="utf-8") == 'farm,s\n"Horns Rev 1, west",3\n'
    assert list(tmp_path.iterdir()) == [out]
    assert capsys.readouterr().out == "farm  s\nHorns Rev 1, west  3\n"


def test_an_interrupt_leaves_the_earlier_table_and_keeps_its_rows_beside_it(tmp_path):
    def rows():
        yield "farm", "s"
        raise KeyboardInterrupt

    out = tmp_path / "table.csv"
    tabulate([("farm", "s"), ("Horns Rev 1", 3)], out)
    with pytest.raises(KeyboardInterrupt):
        tabulate(rows(), out)
    assert out.read_text(encoding="utf-8") == "farm,s\nHorns Rev 1,3\n"
    assert (tmp_path / "table.csv.part").read_text(encoding="utf-8") == "farm,s\n"


def test_a_table_may_be_shown_only(tmp_path, capsys):
    tabulate([("farm", "s")])
    assert capsys.readouterr().out == "farm  s\n"
    assert not list(tmp_path.iterdir())
