"""Times as a user writes them."""

import numpy as np

from windopt.errors import InvalidInput


def parsed(time: str | None) -> np.datetime64 | None:
    """Return a time given in ISO 8601, without a zone.

    Raises
    ------
    InvalidInput
        If it is not one.
    """
    if time is None:
        return None
    try:
        return np.datetime64(time, "s")
    except ValueError:
        raise InvalidInput("--time", "like 2011-04-13T22:00", repr(time)) from None
