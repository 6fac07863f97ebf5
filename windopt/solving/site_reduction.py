r"""Sites that no best choice of p contains, so that the p-median of the rest is small and the same.

Two arguments, each by a bound that exceeds what is known if a site is forced in:

* Of a cover by the fewest sites: the relaxation of :mod:`formulations.station_cover` plus the
  site's reduced cost exceeds p.
* Of the quickest choice: priced at :math:`u_i` each, the rows (2) of
  :mod:`formulations.station_median` leave a problem that is solved by sorting. Site j is worth
  :math:`\rho_j = \sum_i \max(0, u_i - t_{ji})`, the bound is

  .. math:: L(u) = \sum_i u_i - \text{the sum of the } p \text{ greatest } \rho_j,

  and it rises by what the site is worth less than the p-th. The prices climb along subgradients
  [1], and the sites that are chosen on the way make known choices.

* [1] Narula, Ogbu & Samuelsson (1977), *Operations Research* 25, 709-713.
"""

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from formulations.station_cover import station_cover

ROUNDS = 600
PATIENCE = 20  # Rounds without a better bound, after which steps are halved.
LEAST_STEP = 1e-3  # Of the step that would close the gap if the bound were linear.
FEASIBLE = 1e-6  # HiGHS's tolerance on reduced costs is 1e-7, each.
SLACK = 1e-9  # Of the total time; rounding shall exclude nothing.

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]


@dataclass(frozen=True)
class Remaining:
    """What a reduction leaves.

    Parameters
    ----------
    sites
        Sites that a best choice may contain, in order.
    choice
        The best choice that was met, p of them.
    total, bound
        Its total time [s], and the bound on that of any choice.
    """

    sites: Ints
    choice: Ints
    total: float
    bound: float


def sites_of_covers(a: NDArray[np.bool_], p: int) -> Ints:
    """Return the sites that a cover by p may contain.

    Parameters
    ----------
    a
        Whether site j reaches turbine i, shape ``(m, n)``, each by one at least.
    """
    model = station_cover(a).model
    model.setOptionValue("solve_relaxation", True)
    model.setOptionValue("threads", 1)
    model.run()
    solution, bound = model.getSolution(), model.getInfo().objective_function_value
    if not solution.dual_valid:
        return np.arange(len(a))
    return np.flatnonzero(bound + np.array(solution.col_dual) <= p + FEASIBLE)


def remaining_sites(t: Floats, choice: Ints) -> Remaining:
    """Return the sites that a choice of as many as ``choice``, and no slower, may contain.

    Parameters
    ----------
    t
        Time of the round trip from site j to turbine i [s], shape ``(m, n)``; ``inf`` beyond reach.
    choice
        Sites that reach every turbine.
    """
    choice = interchanged(t, choice)
    p, total = len(choice), float(t[choice].min(axis=0).sum())
    u = t[choice].min(axis=0)
    bound, worth, step, waited = -inf, np.zeros(len(t)), 2.0, 0
    for _ in range(ROUNDS):
        rho = np.maximum(u - t, 0.0).sum(axis=1)
        chosen = np.sort(np.argsort(-rho, kind="stable")[:p])
        if (time := float(t[chosen].min(axis=0).sum())) < total:
            choice, total = chosen, time
        low = float(u.sum() - rho[chosen].sum())
        waited += 1
        if low > bound:
            bound, worth, waited = low, rho - rho[chosen].min(), 0
        if waited >= PATIENCE:
            step, waited = step / 2.0, 0
        slope = 1.0 - (t[chosen] < u).sum(axis=0)
        if step < LEAST_STEP or not slope.any():
            break
        u = u + step * (total - low) / (slope @ slope) * slope
    kept = bound - worth <= total * (1.0 + SLACK)
    kept[choice] = True
    return Remaining(np.flatnonzero(kept), choice, total, min(bound, total))


def interchanged(t: Floats, choice: Ints) -> Ints:
    """Return the choice after exchanging one site for another as long as that saves time.

    It is the best exchange each time (Teitz & Bart 1968, *Operations Research* 16, 955-961).
    """
    total = float(t[choice].min(axis=0).sum())
    while True:
        best = total
        for leaving in choice:
            staying = choice[choice != leaving]
            others = t[staying].min(axis=0, initial=inf)
            times = np.minimum(t, others).sum(axis=1)
            if (entering := int(times.argmin())) not in choice and times[entering] < best:
                best, found = float(times[entering]), np.sort(np.append(staying, entering))
        if not best < total * (1.0 - SLACK):
            return choice
        choice, total = found, best
