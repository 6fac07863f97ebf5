"""Station cover and station median against enumeration."""

from itertools import combinations

import numpy as np
import pytest

from formulations.station_cover import station_cover
from formulations.station_median import station_median
from windopt.result import Status
from windopt.solving import solve


def times(m, n, seed):
    """Return distances between random sites and turbines, infinite where they are far apart."""
    rng = np.random.default_rng(seed)
    d = rng.uniform(0, 10, (m, 1, 2)) - rng.uniform(0, 10, (1, n, 2))
    t = np.hypot(d[..., 0], d[..., 1])
    return np.where(t < 5.0, t, np.inf)


def choices(m, p):
    return map(list, combinations(range(m), p))


@pytest.mark.parametrize("seed", range(20))
def test_no_smaller_choice_of_sites_covers_the_turbines(seed):
    a = np.isfinite(times(8, 6, seed))
    sizes = [p for p in range(1, 9) for chosen in choices(8, p) if a[chosen].any(axis=0).all()]
    result = solve(station_cover(a))
    if not sizes:
        assert result.status is Status.INFEASIBLE
    else:
        assert result.status is Status.OPTIMAL
        assert result.objective == min(sizes) == result.bound
        assert a[result.solution > 0.5].any(axis=0).all()


@pytest.mark.parametrize("p", [1, 2, 3])
@pytest.mark.parametrize("seed", range(10))
def test_no_other_choice_of_p_sites_is_quicker(seed, p):
    t = times(8, 6, seed)
    best = min(t[chosen].min(axis=0).sum() for chosen in choices(8, p))
    result = solve(station_median(t, p))
    if np.isinf(best):
        assert result.status is Status.INFEASIBLE
    else:
        assert result.status is Status.OPTIMAL
        assert result.objective == pytest.approx(best)
        assert t[result.solution > 0.5].min(axis=0).sum() == pytest.approx(best)


def test_a_site_at_every_turbine_takes_no_time():
    t = np.abs(np.arange(5.0)[:, None] - np.arange(5.0))
    assert solve(station_median(t, 5)).objective == pytest.approx(0.0)


def test_a_row_of_turbines_is_best_served_from_its_middle():
    t = np.abs(np.arange(7.0)[:, None] - np.arange(7.0))
    assert solve(station_median(t, 1)).solution.argmax() == 3
