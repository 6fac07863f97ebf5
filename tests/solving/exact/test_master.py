"""The master while rows and columns come and go."""

from math import inf

import numpy as np
import pytest

from windopt.solving.exact.clock import Clock
from windopt.solving.exact.crowded_sets import CrowdedSets
from windopt.solving.exact.master import Master
from windopt.solving.exact.search import Search, alone
from windopt.solving.exact.subset_row_cuts import Cuts


def some_flights(rng, master, n):
    """Return columns over random turbines within reach, whether they last too long or not."""
    sizes = rng.integers(1, n + 1, 12)
    paths = [tuple(rng.permutation(n)[:size].tolist()) for size in sizes]
    stations = rng.integers(0, len(master.networks), 12)
    columns = (master.column(int(d), path) for d, path in zip(stations, paths, strict=True))
    return [column for column in columns if np.isfinite(column.cost)]


def some_cuts(rng, n):
    triples = np.array([np.sort(rng.choice(n, 3, replace=False)) for _ in range(3)])
    return Cuts(triples, rng.random((3, n, n)) < 0.7)


def some_sets(rng, n):
    sets = rng.random((2, n)) < 0.5
    sets[:, rng.integers(n)] = True
    return CrowdedSets(sets, np.full(2, 2.0))


def change(rng, master, n):
    """Change columns and rows as the search does."""
    master.add(some_flights(rng, master, n))
    master.cut(some_cuts(rng, n))
    master.enter(some_sets(rng, n))
    master.keep_cuts(rng.random(len(master.cuts)) < 0.7)
    short = np.array([len(column.path) == 1 for column in master.columns])
    master.keep(short | (rng.random(len(master.columns)) < 0.8))
    master.keep_crowded(rng.random(len(master.crowded)) < 0.7)
    counts = master.counts.copy()
    counts[-1, 0] = rng.integers(0, 3)
    master.recount(counts)


@pytest.mark.parametrize("seed", range(20))
def test_a_master_that_changed_is_that_made_anew(seed, small):
    rng = np.random.default_rng(seed)
    instance = small.random_instance(412)
    with Clock(60.0) as clock:
        search = Search(instance, clock)
        n, counts = search.n, np.tile([0.0, inf], (len(search.networks) + 1, 1))
        master = Master(search.networks, counts, search.prize)
        master.add(master.column(d, path) for d, path in alone(search.networks))
        for _ in range(4):
            change(rng, master, n)
            duals = master.solve(clock)
            anew = Master(search.networks, master.counts, search.prize)
            anew.rebuild(master.columns, master.cuts, master.crowded)
            assert anew.solve(clock).value(master.counts) == pytest.approx(master.value)
            assert duals.value(master.counts) == pytest.approx(master.value)
            assert master.reduced_costs() == pytest.approx(reduced_costs(master, duals), abs=1e-6)


def reduced_costs(master, duals):
    paths = [column.path for column in master.columns]
    paid = duals.penalty @ master.cuts.coefficients(paths)
    earned = duals.reward @ master.crowded.entries(paths)
    each = [
        column.cost - duals.pi[list(column.path)].sum() - duals.toll[column.station]
        for column in master.columns
    ]
    return np.array(each) + paid - earned
