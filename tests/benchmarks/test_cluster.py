"""The cluster for all farms: a farm is not split among processors."""

from benchmarks.report.cluster import needed, processors


def test_farms_go_to_the_first_processor_that_has_time():
    assert processors([200.0] * 4) == 4
    assert processors([200.0, 100.0, 150.0, 150.0]) == 2
    assert processors([400.0, 100.0]) == 2  # the first is late, wherever it is


def test_a_farm_counts_with_its_mean(line, rows):
    times = [
        line("exact", 1.0, 1.0, seconds, instance=f"{farm}-w10-090-d{dwell}")
        for farm in "abc"
        for dwell, seconds in (("000", 100.0), ("060", 200.0))
    ]
    (about,) = rows(needed(times))
    assert (about["farms"], about["plans"], about["sum"]) == ("3", "6", "450")
    assert (about["processors"], about["late farms"]) == ("2", "0")


def test_a_failed_case_counts_with_its_limit_and_is_no_plan(line, rows):
    failed = line("exact", 0, 0, 0, instance="a-w10-090-d060", status="failed", limit=300.0)
    planned = line("exact", 1.0, 1.0, 100.0, limit=300.0)
    nothing = line("exact", None, 1.0, 300.0, instance="a-w10-090-d240", limit=300.0)
    (about,) = rows(needed([planned, failed, nothing]))
    assert (about["farms"], about["plans"], about["failed"]) == ("1", "1", "1")
    assert about["sum"] == "233"
