"""Forecasters and networks in tables, whichever problem their lines are of."""

from benchmarks.report.forecast_tables import forecasters, networks

ERRORS = "speed_mae", "speed_rmse", "direction_mae", "direction_rmse"


def line(problem, instance, method, speed_mae, size=None):
    return {
        "problem": problem,
        "instance": instance,
        "method": method,
        "status": "scored",
        "speed_mae": speed_mae,
        "direction_mae": 2.0,
        "normalised": dict.fromkeys(ERRORS, 0.01),
        "bytes": size,
        "cpu": 3.0,
    }


def test_the_papers_rows_count_where_there_is_no_other():
    lines = [
        line("paper", "forecast/persistence", "ours", 0.3),
        line("paper", "forecast/lstm-4", "ours", 0.2),
        line("forecast", "month", "lstm-4", 0.1, size=25_000),
    ]
    assert [row[:2] + row[-2:] for row in forecasters(lines)[1:]] == [
        ["lstm-4", "0.100", "25000", "3.0"],
        ["persistence", "0.300", "-", "3.0"],
    ]


def test_networks_that_are_not_installed_have_no_time():
    timed = [{"network": "4 bits", "microseconds": 612.3, "bytes": 25_000}]
    absent = [{"network": "torch: not installed", "microseconds": None, "bytes": None}]
    edge = {"problem": "edge", "status": "timed", "networks": timed + absent}
    assert networks([edge])[1:] == [["4 bits", "612", "25000"], ["torch: not installed", "-", "-"]]
