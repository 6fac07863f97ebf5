"""Windows: they hold what was measured, in order, and nothing else."""

import numpy as np
import pytest

from windopt.domain.wind import WindSeries
from windopt.errors import InvalidInput
from windopt.forecasting.windows import chronological_split, steps_in, windows

FIVE = np.timedelta64(5, "m")


def series(n, missing=(), step=FIVE):
    """Rows that say their own number: speed i, direction i / 1000."""
    row = np.arange(n, dtype=float)
    speed = row.copy()
    speed[list(missing)] = np.nan
    return WindSeries(np.datetime64("2020-01-01T00:00") + step * np.arange(n), speed, row / 1000)


def test_history_ends_where_the_future_begins():
    found = windows(series(40))
    assert len(found) == 40 - 32 + 1
    assert found.past.speed[3] == pytest.approx(np.arange(3, 27))
    assert found.future.speed[3] == pytest.approx(np.arange(27, 35))
    assert found.future.theta_met[3] == pytest.approx(np.arange(27, 35) / 1000)


def test_no_window_crosses_a_gap():
    found = windows(series(100, missing=[50]))
    assert found.start.tolist() == [*range(50 - 32 + 1), *range(51, 100 - 32 + 1)]
    assert np.isfinite(found.past.speed).all()
    assert np.isfinite(found.future.speed).all()


def test_the_step_decides_how_many_rows_a_duration_takes():
    ten = windows(series(30, step=np.timedelta64(10, "m")))
    assert (ten.history, ten.horizon) == (12, 4)


def test_a_step_that_does_not_divide_the_horizon_is_refused():
    with pytest.raises(InvalidInput, match="horizon"):
        windows(series(300, step=np.timedelta64(15, "m")))
    with pytest.raises(InvalidInput, match="history"):
        steps_in(np.timedelta64(2, "h"), np.timedelta64(7, "m"), "history")


@pytest.mark.parametrize(
    ("n", "missing"), [(3, ()), (31, ()), (60, range(60)), (60, range(0, 60, 20))]
)
def test_a_series_without_a_whole_window_is_refused(n, missing):
    with pytest.raises(InvalidInput, match="wind series"):
        windows(series(n, missing))


def test_blocks_are_the_windows_in_order():
    found = windows(series(100, missing=[50]))
    blocks = list(found.blocks(7))
    assert max(map(len, blocks)) == 7
    assert np.concatenate([b.start for b in blocks]).tolist() == found.start.tolist()


def test_training_ends_before_testing_begins():
    train, test = chronological_split(series(300), test=1 / 3)
    assert len(train) == 200
    assert train.time[-1] + FIVE == test.time[0]


def test_velocity_points_where_the_wind_blows_to():
    found = windows(series(40))
    assert found.past.velocity.reshape(-1, 2) == pytest.approx(
        np.concatenate([series(40).velocity[i : i + 24] for i in range(9)])
    )
