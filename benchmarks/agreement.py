"""Whether two exact methods prove the same optimum: ``python -m benchmarks.agreement``.

Column generation and the flow of flight time share nothing but the instance: one chooses among
flights, the other among legs. They are run on farms of 12 to 16 turbines at random places, with
1 to 3 stations, in a random wind, with a dwell or without, and with flights of random length.
"""

import argparse
from collections import Counter
from collections.abc import Iterator, Sequence
from math import isclose

import numpy as np

from windopt.domain.farm import Farm
from windopt.domain.fleet import Fleet, Station, Uav
from windopt.domain.turbine import Turbine
from windopt.domain.wind import Wind
from windopt.planning.inspection import plan_inspection
from windopt.result import Status

EXTENT = 5000.0
"""Side of the square in which turbines and stations stand [m]."""
SAME = 1e-6
"""Relative; within HiGHS's own tolerances."""


def random_case(seed: int) -> tuple[Farm, Fleet, Wind, float]:
    """Draw a farm, a fleet, a wind and a dwell [s]."""
    rng = np.random.default_rng(seed)
    n, k = int(rng.integers(12, 17)), int(rng.integers(1, 4))
    places = rng.uniform(0.0, EXTENT, (n, 2)).tolist()
    farm = Farm(f"seed {seed}", tuple(Turbine(f"T{i}", x, y) for i, (x, y) in enumerate(places)))
    uav = Uav(t_max=float(rng.uniform(900.0, 1800.0)))
    stations = rng.uniform(0.2 * EXTENT, 0.8 * EXTENT, (k, 2)).tolist()
    fleet = Fleet(tuple(Station(f"S{d}", x, y, uav) for d, (x, y) in enumerate(stations)))
    wind = Wind.from_met(float(rng.uniform(0.0, 11.0)), float(rng.uniform(0.0, 360.0)))
    return farm, fleet, wind, float(rng.choice([0.0, 60.0]))


def verdicts(seeds: Sequence[int], time_limit: float) -> Iterator[tuple[int, str]]:
    """Yield, for each seed, whether both methods prove the same optimum."""
    for seed in seeds:
        farm, fleet, wind, dwell = random_case(seed)
        one, other = (
            plan_inspection(farm, fleet, wind, method=method, dwell=dwell, time_limit=time_limit)
            for method in ("exact", "time-flow")
        )
        unproved = [result for result in (one, other) if result.status is not Status.OPTIMAL]
        slack = SAME * max(one.objective, other.objective)
        crossed = one.bound > other.objective + slack or other.bound > one.objective + slack
        same = isclose(one.objective, other.objective, rel_tol=SAME)
        if crossed or not (unproved or same):
            yield seed, "contradiction"
        else:
            yield seed, f"{len(unproved)} unproved" if unproved else "same optimum"


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a verdict for each instance, and how many there are of each."""
    parser = argparse.ArgumentParser(prog="benchmarks.agreement", description=__doc__)
    parser.add_argument("--instances", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="seed of the first instance")
    parser.add_argument("--time-limit", type=float, default=60.0, help="s, for each method")
    chosen = parser.parse_args(arguments)
    counted: Counter[str] = Counter()
    seeds = range(chosen.first, chosen.first + chosen.instances)
    for seed, verdict in verdicts(seeds, chosen.time_limit):
        counted[verdict] += 1
        print(f"{seed}: {verdict}", flush=True)
    print(", ".join(f"{verdict}: {number}" for verdict, number in counted.most_common()))


if __name__ == "__main__":
    main()
