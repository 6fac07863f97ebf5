"""All flights in a list: of more turbines than a word has bits, of both parities, and too many."""

import numpy as np
import pytest

from windopt.domain.routing import RoutingInstance
from windopt.solving.exact import enumeration
from windopt.solving.exact.clock import Clock
from windopt.solving.exact.enumeration import enumerate_flights
from windopt.solving.exact.relaxation import Relaxation
from windopt.solving.exact.search import Search, alone

AROUND = 70


def ring(stations=1):
    """Return turbines around their stations; a flight has time for one, or two neighbours."""
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    turbines = 1000.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    nodes = np.vstack([[[0.0, 0.0]], turbines])
    t = np.hypot(*(nodes[:, None] - nodes[None]).T)
    longest = 2000.0 + 1.5 * t[1, 2]
    return RoutingInstance(
        np.array([t, t + 1.0][:stations]),
        np.full(stations, longest + 3.0),
        np.zeros((stations, 2)),
        turbines,
        np.zeros(2),
        np.ones((stations, AROUND), bool),
    )


def listed(instance, effort=100_000, **options):
    with Clock(60.0) as clock:
        search = Search(instance, clock)
        search.offer(alone(search.networks))
        relaxation = Relaxation(search, 1e9, search.counts)
        relaxation.begin()
        everything = 10 * search.ceiling
        fixing = relaxation.fix_arcs(ceiling=everything)
        networks = fixing.useful(relaxation.pricer.networks, everything)
        return enumerate_flights(networks, fixing, everything, effort, 1e9, clock, **options)[0]


def sets(pool):
    return sorted(tuple(sorted(pool.path(row))) for row in range(len(pool)))


ALONE = [(i,) for i in range(AROUND)]
PAIRS = [tuple(sorted((i, (i + 1) % AROUND))) for i in range(AROUND)]


@pytest.mark.parametrize("stations", [1, 2])
def test_each_set_is_listed_once_by_its_fastest_station(stations):
    pool = listed(ring(stations))
    assert sets(pool) == sorted(ALONE + PAIRS)
    assert (pool.station == 0).all()


def test_stations_that_may_be_short_of_flights_have_their_own():
    pool = listed(ring(2), apart=True)
    assert sets(pool) == sorted(2 * (ALONE + PAIRS))
    assert np.bincount(pool.station).tolist() == [2 * AROUND, 2 * AROUND]


@pytest.mark.parametrize(("effort", "enough"), [(160, False), (180, True)])
def test_one_parity_may_be_too_many(monkeypatch, effort, enough):
    monkeypatch.setattr(enumeration, "JOINED", 1)  # 105 of the 140 flights are odd
    assert (listed(ring(), effort) is not None) is enough
