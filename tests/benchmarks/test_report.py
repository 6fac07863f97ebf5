"""Tables, pictures and pages are made of lines, failures among them."""

import pytest
from matplotlib.figure import Figure

from benchmarks.records import appended
from benchmarks.report import plots
from benchmarks.report.cluster import needed
from benchmarks.report.pages import write_pages
from benchmarks.report.routing_tables import above, best_known, by_instance, by_method, failures


def line(method, objective, bound, runtime, *, instance="a-w10-090-d000", status="feasible"):
    return {
        "problem": "routing",
        "instance": instance,
        "method": method,
        "time_limit": 10.0,
        "seed": 0,
        "hash": instance,
        "farm": instance[0],
        "turbines": 20,
        "stations": 2,
        "unreachable": 0,
        "status": status,
        "objective": objective,
        "bound": bound,
        "runtime": runtime,
        "cpu": runtime,
        "reason": "out of luck" if status == "failed" else "",
        "trace": [[runtime / 2, objective, bound]],
        "commit": "abc",
        "machine": {"processor": "one", "processors": 1, "memory_gb": 1},
        "versions": {"python": "3"},
        "command": "python -m benchmarks run routing",
    }


LINES = [
    line("exact", 100.0, 100.0, 2.0, status="optimal"),
    line("pyvrp", 103.0, None, 10.0),
    line("exact", 250.0, 200.0, 10.0, instance="b-w10-090-d000"),
    line("pyvrp", 240.0, None, 10.0, instance="b-w10-090-d000"),
    line("broken", None, None, 1.0, status="failed"),
]


def test_the_best_plan_and_the_best_bound_may_be_of_different_methods():
    best = best_known(LINES)["b-w10-090-d000", "b-w10-090-d000"]
    assert (best.objective, best.bound) == (240.0, 200.0)
    assert best.gap == pytest.approx(1 / 6)
    assert above(LINES[2], best) == pytest.approx(0.25)


def test_each_method_is_measured_by_the_best_bound():
    head, exact, pyvrp, broken = by_method(LINES)
    assert dict(zip(head, exact, strict=True))["proved"] == "1"
    assert dict(zip(head, pyvrp, strict=True))["worst"] == "20.00%"
    assert dict(zip(head, broken, strict=True))["failed"] == "1"


def test_each_instance_shows_every_method():
    head, first, second = by_instance(LINES)
    assert dict(zip(head, first, strict=True))["exact"] == "proved, 2.0 s"
    assert dict(zip(head, first, strict=True))["broken"] == "failed"
    assert dict(zip(head, second, strict=True))["best plan s"] == "240.00"


def test_failures_are_shown_with_their_reason():
    assert failures(LINES)[1:] == [["routing", "a-w10-090-d000", "broken", "10", "out of luck"]]


def test_the_cluster_is_the_sum_of_the_times_over_five_minutes():
    times = [line("exact", 1.0, 1.0, 200.0, instance=f"{farm}-w10-090-d000") for farm in "abcd"]
    head, row = needed(times)
    assert dict(zip(head, row, strict=True))["processors"] == "3"  # 800 s in 300 s


@pytest.mark.parametrize(
    "draw", [plots.profile, plots.distances, plots.gap_over_time, plots.growth]
)
def test_pictures_name_their_axes(draw):
    ax = draw(LINES, Figure().subplots())
    assert ax.get_xlabel()
    assert ax.get_ylabel()
    assert ax.get_legend() is not None


def test_pages_show_tables_pictures_and_failures(tmp_path):
    for record in LINES:
        appended(record, tmp_path / "routing.jsonl")
    pages = write_pages(tmp_path, tmp_path / "pages")
    assert [page.stem for page in pages] == ["routing", "cluster"]
    text = pages[0].read_text(encoding="utf-8")
    assert "out of luck" in text
    assert "proved, 2.0 s" in text
    assert all(
        (tmp_path / "pages" / name).is_file()
        for name in ("routing-profile-10.png", "routing-gaps-10.png")
    )
