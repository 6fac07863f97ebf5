"""Ctrl-C as at a terminal, and farms for wake steering that several rooms' tests share."""

import signal

import numpy as np
import pytest

from windopt.domain.power_curve import PowerCurve
from windopt.domain.yaw_problem import YawProblem

D = 120.0
CURVE = PowerCurve(
    (3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 25.0),
    (4e4, 1.8e5, 4.1e5, 7.5e5, 1.2e6, 1.8e6, 2.6e6, 3.5e6, 4.5e6, 5e6, 5e6),
    (0.95, 0.88, 0.82, 0.79, 0.78, 0.78, 0.78, 0.77, 0.70, 0.55, 0.08),
)
WIDER = PowerCurve((3.0, 7.0, 11.0, 25.0), (1e5, 2.6e6, 8e6, 8e6), (0.8, 0.8, 0.7, 0.1))


def pytest_configure():
    """Let Ctrl-C be heard: a shell lets what it runs in the background ignore it."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def steered(xy, *, speed=8.0, direction=270.0, unlike=False, **options):
    """Return turbines at ``xy`` [diameters] in one wind or several [deg], within 25 deg of yaw."""
    xy = D * np.array(xy, dtype=float)
    n = len(xy)
    directions = np.atleast_1d(np.radians(direction))
    S = len(directions)
    kinds = np.arange(n) % 2 if unlike else np.zeros(n, dtype=np.intp)
    options.setdefault("weights", np.full(S, 1 / S))
    return YawProblem(
        xy,
        (CURVE, WIDER) if unlike else (CURVE,),
        kinds,
        np.where(kinds, 160.0, D),
        np.where(kinds, 110.0, 90.0),
        np.full(S, speed),
        directions,
        turbulence=0.06,
        lower=np.full(n, -np.radians(25.0)),
        upper=np.full(n, np.radians(25.0)),
        **options,
    )


def row(n, spacing=5.0):
    """Return ``n`` turbines from west to east [diameters]."""
    return [(spacing * i, 0.0) for i in range(n)]


def scattered(n, seed=0):
    """Return ``n`` turbines at random, 3 diameters apart at least [diameters]."""
    rng = np.random.default_rng(seed)
    side, placed = 4.0 * np.sqrt(n), []
    while len(placed) < n:
        at = rng.uniform(0, side, 2)
        if all(np.hypot(*(at - other)) > 3 for other in placed):
            placed.append(at)
    return placed


@pytest.fixture(name="steered")
def _steered():
    return steered


@pytest.fixture(name="row")
def _row():
    return row


@pytest.fixture(name="scattered")
def _scattered():
    return scattered
