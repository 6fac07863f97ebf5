"""Tables, pictures and pages are made of lines, failures among them."""

import pytest
from matplotlib.figure import Figure

from benchmarks.records import ROOT, appended
from benchmarks.registry import PROBLEMS
from benchmarks.report import plots
from benchmarks.report.best_known import best_known, complete
from benchmarks.report.lines import all_lines, failures, runs
from benchmarks.report.pages import write_pages
from benchmarks.report.routing_tables import (
    beside_optima,
    by_instance,
    by_method,
    relaxation_strength,
)

INDEX = ROOT / "docs" / "benchmarks" / "index.rst"


def test_each_method_is_measured_by_the_best_bound(lines, rows):
    exact, pyvrp, broken = rows(by_method(lines, best_known(lines)))
    assert (exact["proved"], exact["CPU s a plan: median"]) == ("1", "6.0")
    assert pyvrp["worst"] == "20.00%"
    assert broken["failed"] == "1"


def test_heuristics_are_counted_that_found_the_proved_optimum(lines, line, rows):
    longer = line("exact", 240.0, 240.0, 99.0, instance="b-w10-090-d000", status="optimal")
    known = best_known([*lines, longer | {"time_limit": 300.0}])
    exact, pyvrp, broken = rows(beside_optima(complete(lines), known))
    assert (pyvrp["cases with a proved optimum"], pyvrp["optimum found"]) == ("2", "1")
    assert pyvrp["worst"] == "3.00%"
    assert (exact["optimum found"], exact["share"]) == ("1", "50%")
    assert broken["optimum found"] == "0"


def test_each_instance_shows_every_method_and_what_failed(lines, rows):
    first, second = rows(by_instance(complete(lines), best_known(lines)))
    assert first["exact"] == "proved, 2.0 s"
    assert first["broken"] == "failed"
    assert second["best plan s"] == "240.00"


def test_an_instance_that_every_method_failed_on_keeps_its_row(line, rows):
    lost = [line(method, 0, 0, 0, status="failed") for method in ("exact", "pyvrp")]
    (row,) = rows(by_instance(complete(lost), best_known(lost)))
    assert (row["farm"], row["n"], row["best plan s"]) == ("a", "-", "-")
    assert (row["exact"], row["pyvrp"]) == ("failed", "failed")


def test_relaxations_are_measured_by_the_best_plan(lines, line, rows):
    exact = {**lines[0], "lp_bound": 90.0}
    lp = line("time-flow-lp", None, 60.0, 1.0, status="no_solution")
    flow, columns = rows(relaxation_strength([exact, lp], best_known([exact, lp])))
    assert (flow["formulation"], flow["median"]) == ("time-flow", "60.0%")
    assert (columns["formulation"], columns["median"]) == ("exact", "90.0%")


def test_failures_are_shown_with_their_reason(lines):
    assert failures(lines)[1:] == [["routing", "a-w10-090-d000", "broken", "10", "out of luck"]]


def test_of_several_lines_of_a_case_the_last_counts(lines, tmp_path):
    for name, record in ("one", lines[2]), ("two", {**lines[2], "objective": 249.0}):
        appended(record, tmp_path / f"{name}.jsonl")
    (kept,) = all_lines(tmp_path)
    assert kept["objective"] == 249.0


def test_what_was_run_is_told_by_command(lines, rows):
    (told,) = rows(runs(lines))
    assert told["command"] == "``python -m benchmarks run routing``"
    assert (told["cases"], told["failed"], told["machine"]) == ("5", "1", "one, 1 processors")


@pytest.mark.parametrize(
    "draw",
    [
        plots.profile,
        plots.distances,
        plots.gap_over_time,
        plots.bound_over_time,
        plots.growth,
        plots.growth_by_dwell,
    ],
)
def test_pictures_name_their_axes(draw, lines):
    ax = draw(complete(lines), best_known(lines), Figure().subplots())
    assert ax.get_xlabel()
    assert ax.get_ylabel()
    assert ax.get_legend() is not None


def test_what_was_not_proved_is_drawn_open_and_what_failed_at_its_limit(lines):
    ax = plots.growth(complete(lines), best_known(lines), Figure().subplots())
    drawn = [dots for dots in ax.collections if len(dots.get_offsets())]
    full, *open_marks = sorted(drawn, key=lambda dots: -len(dots.get_facecolor()))
    assert full.get_offsets().tolist() == [[20.0, 2.0]]
    assert not any(len(dots.get_facecolor()) for dots in open_marks)
    assert any(dots.get_offsets().tolist() == [[20.0, 10.0]] for dots in open_marks)


def curves(draw, lines):
    ax = draw(complete(lines), best_known(lines), Figure().subplots())
    return {curve.get_label(): curve.get_ydata() for curve in ax.get_lines()}


def test_a_method_without_a_plan_for_every_instance_has_no_curve(lines, line):
    lost = line("pyvrp", None, None, 10.0, status="no_solution")
    assert set(curves(plots.gap_over_time, lines[:4])) == {"exact", "pyvrp"}
    assert set(curves(plots.gap_over_time, [lines[0], lost, *lines[2:4]])) == {"exact"}
    failed = line("pyvrp", 0, 0, 0, status="failed")
    assert set(curves(plots.gap_over_time, [lines[0], failed, *lines[2:4]])) == {"exact"}


def test_a_plan_a_little_later_than_the_limit_has_its_curve(lines, line):
    late = line("pyvrp", 103.0, None, 10.02)
    late["trace"] = []
    assert set(curves(plots.gap_over_time, [lines[0], late, *lines[2:4]])) == {"exact", "pyvrp"}


def test_an_instance_without_a_known_bound_is_left_out_for_all(lines, line):
    unknown = [line(name, 9.0, None, 1.0, instance="c-w10-090-d000") for name in ("exact", "pyvrp")]
    for draw in plots.gap_over_time, plots.bound_over_time:
        before, after = curves(draw, lines), curves(draw, [*lines, *unknown])
        assert before.keys() == after.keys()
        assert all((before[name] == after[name])[-1] for name in before)


def test_pages_show_tables_pictures_and_failures(lines, line, tmp_path):
    unknown = [line(name, 9.0, None, 1.0, instance="c-w10-090-d000") for name in ("exact", "pyvrp")]
    for record in [*lines, *unknown]:
        appended(record, tmp_path / "routing.jsonl")
    grid = {**lines[0], "instance": "grid20-w10-090-d000"}
    appended(grid, tmp_path / "growth.jsonl")
    pages = write_pages(tmp_path, tmp_path / "pages")
    text = {page.stem: page.read_text(encoding="utf-8") for page in pages}
    assert list(text) == ["routing", "routing-farms", "routing-cases", "growth", "cluster", "runs"]
    assert "out of luck" in text["routing"]
    assert "proved, 2.0 s" in text["routing-cases"]
    assert "1 of 3" in text["routing"]
    assert text["routing"].count("are left out for all methods: 1.") == 2  # in two captions
    for name in "routing-profile-1", "routing-gaps-1", "routing-farms", "growth-10":
        assert (tmp_path / "pages" / f"{name}.png").is_file()


def test_heuristics_alone_are_shown_without_bounds(line, tmp_path):
    for method, objective in ("pyvrp", 103.0), ("or-tools", 104.0):
        appended(line(method, objective, None, 10.0), tmp_path / "routing.jsonl")
    pages = write_pages(tmp_path, tmp_path / "pages")
    text = {page.stem: page.read_text(encoding="utf-8") for page in pages}
    assert "no bound" in text["routing"]
    assert "no bound, 10.0 s" in text["routing-cases"]
    assert ".png" not in text["routing"]


def test_pages_that_no_line_makes_any_more_are_removed_and_no_other_file(line, tmp_path):
    kept, pages = tmp_path / "routing.jsonl", tmp_path / "pages"
    pages.mkdir()
    mine = pages / "notes.rst"
    mine.write_text("mine", encoding="utf-8")
    appended(line("exact", 1.0, 1.0, 1.0, instance="grid20-w10-090-d000"), kept)
    write_pages(tmp_path, pages)
    assert (pages / "growth.rst").exists()
    assert (pages / "growth-10.png").exists()
    kept.unlink()
    write_pages(tmp_path, pages)
    assert {path.name for path in pages.iterdir()} == {"notes.rst", "made.txt"}


def test_every_problem_has_its_page_among_the_benchmarks():
    index = INDEX.read_text(encoding="utf-8")
    for name in PROBLEMS:
        assert f"``{name}``" in index
        assert f"generated/{name}" in index or name == "edge"  # which is told with the networks
