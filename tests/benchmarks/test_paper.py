"""The paper's tables: its routing example comes out, and hourly means turn nacelles worse."""

import pytest

pytest.importorskip("torch")  # the paper's forecasts are trained

from benchmarks.case import Case
from benchmarks.closed_loop import loop
from benchmarks.paper import PROBLEM, measure
from benchmarks.report.columns import as_text
from benchmarks.report.paper_tables import PAPER_ROUTING, TABLES


def row(name):
    return measure(Case("paper", name, "ours", 60.0)) | {"problem": "paper", "instance": name}


@pytest.mark.parametrize("method", PAPER_ROUTING)
def test_the_papers_plans_and_times_come_out_on_the_reconstruction(method):
    minutes, flights = PAPER_ROUTING[method]
    found = row(f"routing on reconstructed/{method}")
    assert found["minutes"] == pytest.approx(minutes, abs=1e-4)  # the paper's last digit
    assert sorted(found["flights"]) == sorted(flights.split(", "))


def test_the_papers_plan_is_proved_best_on_the_reconstruction():
    found = row("routing on reconstructed/exact")
    assert found["status"] == "optimal"
    assert found["minutes"] == pytest.approx(PAPER_ROUTING["algorithm-2"][0], abs=1e-4)


def test_no_forecast_delivers_more_than_the_true_wind_and_hourly_means_deliver_less():
    true, every_step, hourly = (loop(name) for name in ("true wind", "every step", "hour ahead"))
    for period in "hour_kwh", "day_kwh", "all_kwh":
        assert hourly[period] < every_step[period] <= true[period]
    assert hourly["day_degrees_off"] > every_step["day_degrees_off"] > 0


def test_the_four_tables_print_whatever_was_made():
    rows = [row("yaw/true wind"), row("routing on walney/exact")]
    printed = [as_text(title, make(rows)) for title, make in TABLES.items()]
    assert len(printed) == 4
    assert "ours: true wind" in printed[2]
    assert "walney: exact" in printed[3]
    assert PROBLEM.instances("small") == PROBLEM.instances("full")
    assert not PROBLEM.instances("guard")
