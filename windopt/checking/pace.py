"""Whether nacelles turn from step to step no faster than a plan says they can."""

from collections.abc import Iterator
from itertools import pairwise
from math import degrees, pi

import numpy as np

from windopt.checking.turbine_yaw import ANGLE_TOLERANCE
from windopt.domain.plan import Plan, SetPoint, YawPlan


def too_fast(plan: Plan) -> Iterator[str]:
    """Yield a sentence for every nacelle that turns too far from one step to the next.

    One that the wind has left behind may come within the bounds of its misalignment and no
    further. Where nacelles stand before the first step is not part of a plan.
    """
    if plan.pace is None:
        return
    times = pairwise(plan.forecast.time)
    for (begin, end), (earlier, later) in zip(times, pairwise(plan.yaw), strict=False):
        if earlier.solution is None or later.solution is None:
            continue
        seconds = float((end - begin) / np.timedelta64(1, "s"))
        reach = plan.pace.rate * seconds + ANGLE_TOLERANCE
        points = zip(earlier.solution.set_points, later.solution.set_points, strict=False)
        for before, after in points:
            turned = abs((after.nacelle - before.nacelle + pi) % (2 * pi) - pi)
            if turned > reach and not _at_a_bound(after, later.solution):
                yield (
                    f"yaw at {end}: turbine {after.turbine}: the nacelle turns by "
                    f"{degrees(turned):.6g} deg in {seconds:g} s, more than it can"
                )


def _at_a_bound(point: SetPoint, plan: YawPlan) -> bool:
    if plan.steering is None:
        return False
    bounds = plan.steering.lower, plan.steering.upper
    return any(abs(point.misalignment - bound) <= ANGLE_TOLERANCE for bound in bounds)
