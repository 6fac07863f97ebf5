"""The first plan of a search: savings or a start, made better by local search."""

from collections.abc import Sequence

from windopt.solving.exact.local_search import improve
from windopt.solving.exact.savings import savings
from windopt.solving.exact.search import Flight, Search


def find_plan(search: Search, seed: int, start: Sequence[Flight] = (), effort: int = 1) -> None:
    """Offer the search the plan of the savings, nothing at all and a start, and improve the best.

    Parameters
    ----------
    seed, effort
        Of the local search.
    start
        Flights to begin with where they take less time than the savings.
    """
    search.offer(savings(search.networks, search.counts[:-1, 1], search.prize))
    search.offer(())
    search.offer(start)
    if search.found:
        improve(search, seed, effort)
