"""Whole farms: how many plans were proved, and how far the others may be from the best."""

from benchmarks.report.farm_tables import every_farm, proofs, unproved, whole_farms


def farms(line):
    return [
        line("exact", 100.0, 100.0, 2.0, status="optimal", limit=300.0),
        line("exact", 250.0, 200.0, 300.0, instance="b-w10-090-d000", limit=300.0),
        line("exact", 200.0, 190.0, 300.0, instance="c-w10-090-d000", limit=300.0),
        line("exact", 400.0, 300.0, 300.0, instance="a-w10-090-d060", limit=300.0),
        line("exact", 0.0, 0.0, 0.0, instance="b-w10-090-d060", status="failed", limit=300.0),
    ]


def test_the_longest_limit_of_the_exact_method_counts(line):
    shorter = [line("exact", 100.0, 90.0, 10.0), line("pyvrp", 100.0, None, 400.0, limit=400.0)]
    assert len(whole_farms([*shorter, *farms(line)])) == 5


def test_proofs_are_counted_for_each_dwell(line, rows):
    at_once, inspected = rows(proofs(farms(line)))
    assert (at_once["proved"], at_once["wall s: median"]) == ("1 of 3", "2.0")
    assert (at_once["gap of the rest: median"], at_once["worst"]) == ("12.50%", "20.00%")
    assert (inspected["proved"], inspected["without a plan"]) == ("0 of 2", "1")


def test_what_is_not_proved_is_listed_by_its_gap(line, rows):
    assert [row["gap"] for row in rows(unproved(farms(line)))] == ["5.00%", "20.00%", "25.00%"]


def test_every_farm_has_a_row_whatever_came_of_it(line, rows):
    *_, failed = rows(every_farm(farms(line)))
    assert (failed["status"], failed["plan s"], failed["farm"]) == ("failed", "-", "b")
    assert rows(every_farm(farms(line)))[1]["gap"] == "20.00%"
