"""Sites that are left out are in no best choice."""

from itertools import combinations

import numpy as np
import pytest

from windopt.solving.site_reduction import interchanged, remaining_sites, sites_of_covers


def times(m, n, seed):
    """Return distances between random sites and turbines, infinite where they are far apart."""
    rng = np.random.default_rng(seed)
    d = rng.uniform(0, 10, (m, 1, 2)) - rng.uniform(0, 10, (1, n, 2))
    t = np.hypot(d[..., 0], d[..., 1])
    return np.where(t < 6.0, t, np.inf)


def totals(t, p):
    return {c: t[list(c)].min(axis=0).sum() for c in combinations(range(len(t)), p)}


@pytest.mark.parametrize("p", [2, 3])
@pytest.mark.parametrize("seed", range(20))
def test_every_best_choice_and_every_least_cover_remains(seed, p):
    t = times(12, 8, seed)
    total = {c: time for c, time in totals(t, p).items() if np.isfinite(time)}
    if not total:
        pytest.skip("no choice of as many reaches every turbine")
    best = min(total.values())
    left = remaining_sites(t, np.array(max(total, key=total.get)))
    assert left.bound <= best * (1 + 1e-9) <= left.total * (1 + 2e-9)
    assert t[left.choice].min(axis=0).sum() == pytest.approx(left.total)
    covering = set(sites_of_covers(np.isfinite(t), p).tolist())
    for choice, time in total.items():
        assert set(choice) <= covering
        if time <= best * (1 + 1e-12):
            assert set(choice) <= set(left.sites.tolist())


def test_far_sites_are_left_out():
    line = np.arange(100.0)
    t = np.abs(line[:, None] - line[40:61])
    assert remaining_sites(t, np.array([0])).sites.tolist() == [50]


@pytest.mark.parametrize("seed", range(10))
def test_no_exchange_of_two_sites_saves_time_any_more(seed):
    t = times(12, 8, seed)
    found = interchanged(t, np.arange(5))
    total = t[found].min(axis=0).sum()
    for leaving in found:
        for entering in set(range(12)) - set(found.tolist()):
            other = np.where(found == leaving, entering, found)
            assert t[other].min(axis=0).sum() >= total * (1 - 1e-9) or np.isinf(total)
