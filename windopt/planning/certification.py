"""Certificates of inspection plans: domain objects in, a proof of the bound out."""

from math import isfinite

from windopt.domain.certificate import Certificate
from windopt.domain.plan import InspectionPlan
from windopt.domain.routing import Route
from windopt.errors import InvalidInput, require_kind
from windopt.planning.assignment import assigned_to
from windopt.planning.reach import routing_instance
from windopt.planning.worth import weighed
from windopt.result import Result


def certify(
    result: Result[InspectionPlan], *, time_limit: float = 300.0, memory: float = 4e9
) -> Certificate:
    """Prove the bound of a plan in numbers that :func:`windopt.check` verifies.

    Parameters
    ----------
    result
        Flights by any method, and the bound on their total time.
    time_limit
        Wall-clock limit [s].
    memory
        What the search for the proof may take [bytes].

    Returns
    -------
    Certificate
        Of a lower bound than claimed where time or memory ran out, or the user interrupts.

    Raises
    ------
    ValueError
        With the reason, if the result holds no plan.
    InvalidInput
        If no bound is claimed.
    """
    from windopt.solving.certification import certify as prove  # compiled loops load slowly
    from windopt.solving.readiness import make_ready

    require_kind("result", result, Result)
    plan = result.found()
    require_kind("solution", plan, InspectionPlan)
    if not isfinite(result.bound):
        raise InvalidInput("bound", "to be proved, for a certificate", result.bound)
    make_ready()
    beyond = {unreachable.turbine for unreachable in plan.unreachable}
    reached = [i for i, name in enumerate(plan.farm.names) if name not in beyond]
    turbines = tuple(plan.farm.names[i] for i in reached)
    routes = tuple(
        Route(plan.fleet.names.index(flight.station), tuple(map(turbines.index, flight.turbines)))
        for flight in plan.flights
    )
    everything = routing_instance(
        plan.farm, plan.fleet, plan.wind, dwell=plan.dwell, rule=plan.rule
    )
    assigned = assigned_to(everything, plan.fleet, plan.assignment)
    instance = weighed(assigned, plan.fleet, plan.worth).subset(reached)
    proved = prove(instance, routes, result.bound, time_limit=time_limit, memory=memory)
    return Certificate(turbines, plan.fleet.names, proved.proof, proved.reason)
