"""Placements of stations as records, ready for JSON; SI throughout."""

from collections.abc import Sequence
from math import isfinite

from windopt.domain.fleet import Fleet
from windopt.io.plan_records import Record, station_record
from windopt.planning.station_comparison import Placement
from windopt.result import Result


def placement_record(
    result: Result[Fleet], placed: Placement | None, beside: Sequence[Placement]
) -> Record:
    """Record a placement, what proves it and what others achieve.

    Parameters
    ----------
    placed
        What the result's stations achieve; ``None`` where it has none.
    beside
        Other placements, for comparison.
    """
    numbers = {
        name: value if isfinite(value) else None
        for name, value in {
            "objective": float(result.objective),
            "bound": float(result.bound),
            "gap": result.gap,
            "runtime": result.runtime,
        }.items()
    }
    return {
        "kind": "stations",
        "status": str(result.status),
        **numbers,
        "bound_source": result.bound_source,
        "reason": result.reason,
        "stations": [station_record(s) for s in placed.fleet.stations] if placed else [],
        "placement": _achieved(placed) if placed else None,
        "beside": [_achieved(other) for other in beside],
    }


def _achieved(placed: Placement) -> Record:
    return {
        "method": placed.method,
        "stations": len(placed.fleet),
        "beyond_reach": placed.beyond,
        "time": placed.time,
        "longest": placed.longest,
    }
