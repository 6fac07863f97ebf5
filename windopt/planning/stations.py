"""Stations for a farm that has none: the fewest by an exact cover, and k-means beside it.

The paper places UAVs by k-means and leaves open how many. Here the number is the least from which
every turbine is within reach (:mod:`formulations.station_cover`), and of the placements of that
number the one with the shortest round trips is taken (:mod:`formulations.station_median`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, inf
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from formulations.station_cover import station_cover
from formulations.station_median import station_median
from windopt.checking.stations import check_stations
from windopt.domain.farm import Farm
from windopt.domain.fleet import FALCON_8, Fleet, Station, Uav
from windopt.domain.turbine import require_not_negative
from windopt.domain.wind import Wind
from windopt.errors import FailedCheck, InvalidInput
from windopt.heuristics.placement import place_stations
from windopt.planning.station_design import MARGIN, StationDesign, design_winds, station_design
from windopt.planning.station_sites import DEFAULT_CANDIDATES, candidate_sites
from windopt.result import Result, Status
from windopt.solving.integer import solve
from windopt.solving.site_reduction import remaining_sites, sites_of_covers

__all__ = [
    "METHODS",
    "design_winds",
    "placed_by_cover",
    "placed_by_k_means",
    "stations_by_cover",
    "stations_by_k_means",
]

METHODS = "cover", "k-means"
"""How stations are placed: at the best of candidate sites, or at the centres of clusters."""

Floats = NDArray[np.float64]
Chosen = NDArray[np.float64]  # one where there is a station, shape (m,)


def stations_by_cover(
    farm: Farm,
    count: int | None = None,
    *,
    uav: Uav = FALCON_8,
    dwell: float | Sequence[float] = 0.0,
    winds: Sequence[Wind] | None = None,
    margin: float = MARGIN,
    candidates: str | Floats = DEFAULT_CANDIDATES,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[Fleet]:
    """Place the fewest stations that reach every turbine, or a given number of the quickest.

    Parameters
    ----------
    count
        How many; as few as reach every turbine unless given.
    uav
        The make of UAV kept at each.
    dwell
        Time spent at each turbine [s]: one for all, or one each in the farm's order.
    winds
        Design winds, those of :func:`design_winds` unless given; any that the UAV does not fly in
        are left out.
    margin
        Share of ``t_max`` that is left on landing [-].
    candidates
        Where stations may be: one of :data:`windopt.planning.station_sites.CANDIDATES`, or the
        positions themselves [m], shape ``(m, 2)``.
    time_limit
        Wall-clock limit [s].

    Returns
    -------
    Result
        The objective is the number of stations or, with ``count``, the total time of a round trip
        to each turbine [s], mean over the winds. Bounds hold for the candidate sites.
        Where no station reaches a turbine the reason names it.

    Raises
    ------
    InvalidInput
        If a dwell, the margin, the candidates, the count or the limit cannot be used, or the UAV
        flies in none of the winds.
    FailedCheck
        If the independent checker finds a turbine beyond reach.
    """
    design = station_design(farm, uav=uav, dwell=dwell, winds=winds, margin=margin)
    return placed_by_cover(design, count, candidates=candidates, time_limit=time_limit, seed=seed)


def placed_by_cover(
    design: StationDesign,
    count: int | None = None,
    *,
    candidates: str | Floats = DEFAULT_CANDIDATES,
    time_limit: float = 60.0,
    seed: int = 0,
) -> Result[Fleet]:
    """Place stations for a design; see :func:`stations_by_cover`."""
    start = perf_counter()
    require_not_negative("time_limit", time_limit)
    sites = candidate_sites(design, candidates, seed=seed)
    most = min(len(design.farm), len(sites))
    if count is not None and not 1 <= count <= most:
        raise InvalidInput("stations", f"to number 1 to {most}", count)
    search = _Search(design.round_trips(sites), start + time_limit, seed)
    found = search.fewest() if count is None else search.quickest(count)
    result: Result[Fleet] = found.carrying(None)
    if found.solution is not None:
        fleet = _fleet(sites[found.solution > 0.5], design.uav)
        _assert_in_reach(design, fleet)
        result = found.carrying(fleet)
    elif not search.reached.all():
        result = replace(result, reason=_beyond_reach(design, search.reached))
    return result.timed(perf_counter() - start)


def placed_by_k_means(
    design: StationDesign, count: int | None = None, *, seed: int = 0
) -> Result[Fleet]:
    """Place stations for a design by k-means, which proves nothing.

    With ``count``, turbines may be left beyond reach, and the objective is then infinite.
    """
    start = perf_counter()
    if count is None and max(design.dwell) > design.longest:
        reason = _beyond_reach(design, np.array(design.dwell) <= design.longest)
        return Result(Status.INFEASIBLE, None, inf, inf, perf_counter() - start, reason=reason)
    fleet = stations_by_k_means(
        design.farm,
        count,
        uav=design.uav,
        dwell=design.dwell,
        winds=design.winds,
        margin=design.margin,
        seed=seed,
    )
    objective = design.total_time(fleet) if count is not None else float(len(fleet))
    return Result(Status.FEASIBLE, fleet, objective, -inf, perf_counter() - start)


def stations_by_k_means(
    farm: Farm,
    count: int | None = None,
    *,
    uav: Uav = FALCON_8,
    dwell: float | Sequence[float] = 0.0,
    winds: Sequence[Wind] | None = None,
    margin: float = 0.0,
    least: int = 1,
    seed: int = 0,
) -> Fleet:
    """Place stations at the centres of k-means clusters of the turbines.

    More clusters may reach less, so without ``count`` the numbers are tried one after the other.

    Parameters
    ----------
    count
        How many; as few as reach every turbine in all of ``winds`` unless given.
    uav, dwell, winds, margin
        As for :func:`stations_by_cover`.
    least
        The first number to try.

    Raises
    ------
    InvalidInput
        If ``count`` is not between 1 and the number of turbines, a dwell is longer than a flight
        may last, or as :func:`stations_by_cover` does.
    """
    if count is not None:
        if not 1 <= count <= len(farm):
            raise InvalidInput("stations", f"to number 1 to {len(farm)}", count)
        return _fleet(place_stations(farm.xy, count, seed=seed), uav)
    design = station_design(farm, uav=uav, dwell=dwell, winds=winds, margin=margin)
    if max(design.dwell) > design.longest:
        expected = f"<= {design.longest:g} s, which a flight may last"
        raise InvalidInput("dwell", expected, f"{max(design.dwell):g}")
    for k in range(max(1, least), len(farm)):
        centres = place_stations(farm.xy, k, seed=seed)
        if np.isfinite(design.round_trips(centres)).any(axis=0).all():
            return _fleet(centres, uav)
    return _fleet(farm.xy, uav)  # one at each turbine, which takes no flying


@dataclass(frozen=True)
class _Search:
    """Choices among sites, by the time of a round trip from each to each turbine."""

    t: Floats  # (m, n) s; inf beyond reach
    deadline: float
    seed: int

    @property
    def reached(self) -> NDArray[np.bool_]:
        """Whether some site reaches turbine i, shape ``(n,)``."""
        return np.asarray(np.isfinite(self.t).any(axis=0))

    def cover(self) -> Result[Chosen]:
        """Choose the fewest sites; the objective is their number."""
        if not self.reached.all():
            return Result(Status.INFEASIBLE, None, inf, inf, 0.0, "reach of the candidate sites")
        found = solve(station_cover(np.isfinite(self.t)), time_limit=self._left, seed=self.seed)
        bound = max(1.0, ceil(found.bound - 1e-6)) if found.bound > -inf else 1.0
        source = f"{found.bound_source}, over {len(self.t)} sites"
        return replace(found, bound=bound, bound_source=source)

    def median(self, count: int, cover: Result[Chosen]) -> Result[Chosen]:
        """Choose ``count`` sites among those that a reduction leaves, beginning with a cover."""
        known = cover.found() > 0.5
        others = np.flatnonzero(~known)[: count - int(known.sum())]
        start = np.union1d(np.flatnonzero(known), others)
        sites = np.arange(len(self.t))
        if count == cover.bound:
            sites = np.union1d(sites_of_covers(np.isfinite(self.t), count), start)
        left = remaining_sites(self.t[sites], np.searchsorted(sites, start))
        found = solve(
            station_median(self.t[sites[left.sites]], count),
            time_limit=self._left,
            seed=self.seed,
            start=np.isin(left.sites, left.choice).astype(float),
        )
        if found.solution is None:
            return found
        chosen = np.zeros(len(self.t))
        chosen[sites[left.sites]] = found.solution
        return replace(found.carrying(chosen), bound=max(found.bound, left.bound))

    def fewest(self) -> Result[Chosen]:
        """Choose the fewest sites, and of as many the quickest; the objective is their number."""
        cover = self.cover()
        if cover.solution is None or cover.status is Status.INTERRUPTED:
            return cover
        median = self.median(round(cover.objective), cover)
        if median.solution is None:
            return replace(cover, reason="Which of as many are the quickest was not asked.")
        unproven = f"Round trips from as many may be up to {median.gap:.2%} shorter."
        reason = "" if median.status is Status.OPTIMAL else unproven
        return replace(cover.carrying(median.solution), reason=reason)

    def quickest(self, count: int) -> Result[Chosen]:
        """Choose ``count`` sites; the objective is the total time of the round trips."""
        cover = self.cover()
        if cover.solution is None:
            return cover
        if count < cover.bound:
            least = f"{count} cannot reach every turbine: it takes {cover.bound:.0f} or more."
            return Result(Status.INFEASIBLE, None, inf, inf, 0.0, cover.bound_source, least)
        found = self.median(count, cover)
        return replace(found, bound_source=f"{found.bound_source}, over {len(self.t)} sites")

    @property
    def _left(self) -> float:
        return max(0.0, self.deadline - perf_counter())


def _fleet(sites: Floats, uav: Uav) -> Fleet:
    """Return stations at the sites, counted from west to east."""
    from_west = sites[np.lexsort(sites.T[::-1])].tolist()
    return Fleet(tuple(Station(f"S{i}", x, y, uav) for i, (x, y) in enumerate(from_west, 1)))


def _assert_in_reach(design: StationDesign, fleet: Fleet) -> None:
    report = check_stations(
        design.farm, fleet, design.winds, dwell=design.dwell, margin=design.margin
    )
    if not report.passed:
        raise FailedCheck(report.violations)


def _beyond_reach(design: StationDesign, reached: NDArray[np.bool_]) -> str:
    """Name the first turbine that no site reaches, and say why."""
    i = int(np.flatnonzero(~reached)[0])
    name, dwell, others = design.farm.names[i], design.dwell[i], int((~reached).sum()) - 1
    also = f" (nor {others} others)" if others else ""
    if dwell > design.longest:
        limit = f"a flight may last {design.longest:.0f} s"
        return f"No station inspects turbine {name}{also}: its dwell is {dwell:.0f} s, {limit}."
    return f"No candidate site reaches turbine {name}{also} in every design wind."
